// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/stepping/paper_flow.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "filter_tracked_mcf/core/flow/plan/setup_phases.h"
#include "filter_tracked_mcf/core/flow/stepping/mean_curvature.h"
#include "filter_tracked_mcf/core/flow/system/constrained_cells.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"
#include "filter_tracked_mcf/core/parallel/stopwatch.h"

namespace tracked_mcf {

namespace {

/// The fraction of a step's time before the solver begins.
constexpr double kShareOfIntegrals = 0.45;

/// How far a step may take the surface out of its box, in the box's diagonals.
constexpr double kMostOutside = 0.1;

/// Returns the flags of unknowns that do not change, by level.
std::vector<std::vector<std::uint8_t>> fixed_unknowns(const TrackedElements& elements) {
    enter_setup_phase(kPrepareSolver);
    auto constrained = constrained_unknowns(elements);
    constrain_negligible(elements, constrained.back());
    return constrained;
}

}  // namespace

PaperFlow::PaperFlow(PaperPlan plan)
    : SurfaceFlow(plan),
      order_(plan.steps.order),
      cycles_(plan.cycles),
      step_size_(plan.step_size / (plan.clipped.grid.cell_size * plan.clipped.grid.cell_size)),
      elements_(build_tracked_elements(surface_, std::move(plan.clipped), plan.cubature)),
      multigrid_(elements_, fixed_unknowns(elements_)),
      displacement_(Coefficients::Zero(elements_.finest().unknown_count(), 3)) {
    report_.depth = elements_.grid.depth;
    report_.cell_size = elements_.grid.cell_size;
    report_.cells = count_cells(elements_.finest());
    report_.elements = elements_.finest().element_count();
    report_.unknowns = elements_.finest().unknown_count();
    const std::vector<std::uint8_t> locked = constrained_unknowns(elements_).back();
    report_.constrained_unknowns = std::count(locked.begin(), locked.end(), 1);
    report_.fragments = elements_.fragment_count;
    report_.split_triangles = elements_.split_triangle_count;
    report_.samples = static_cast<std::int64_t>(elements_.samples.size());
}

bool PaperFlow::step() {
    StepReport report;
    report.error_estimate = kNoNumber;
    const Stopwatch assembling;
    assemble_elements(elements_, displacement_, step_size_, order_ > 1, systems_);
    const double cell = elements_.grid.cell_size;
    report.area = systems_.area * cell * cell;
    report.collapsed_samples = systems_.collapsed_samples;
    if (first_area_ == 0) first_area_ = systems_.area;
    if (systems_.area < kVanishedArea * first_area_) {
        end_before_last_step(Stop::Vanished);
        return false;
    }
    if (report_.constrained_unknowns == report_.unknowns ||
        report_.held_vertices == report_.vertices) {
        report_.stop = Stop::NothingMoves;
        return false;
    }
    multigrid_.refresh(systems_.matrices);
    report.assemble_seconds = assembling.seconds();
    const ProgressSpan solving(kShareOfIntegrals, 1);
    const Stopwatch stopwatch;
    for (int i = 0; i < order_; ++i) {
        const ProgressSpan span(1.0 * i / order_, (i + 1.0) / order_);
        // A d = δ S d', where d' is the displacement of a step of one order less
        if (i > 0) multiply(elements_, systems_.stiffnesses, d_, systems_.right_sides);
        solve(systems_.right_sides, report);
    }
    report.solve_seconds = stopwatch.seconds();
    d_ += displacement_;  // x(t+δ) = x(t) + d
    if (!is_confined(d_)) {
        report_.stop = Stop::StepFailed;
        return false;
    }
    before_ = std::exchange(displacement_, d_);
    report_.steps.push_back(report);
    return true;
}

void PaperFlow::solve(const Field& right_sides, StepReport& report) {
    const LevelMatrix& finest = multigrid_.finest();
    sum_at_unknowns(elements_.finest(), right_sides, right_side_);
    set_zero(x_, right_side_.cols());
    finest.residual(right_side_, x_, residual_);
    report.residual_before = std::hypot(report.residual_before, norm(residual_));
    for (int i = 0; i < cycles_; ++i) {
        multigrid_.cycle(right_side_, x_);
        advance_progress((i + 1.0) / cycles_);
    }
    finest.residual(right_side_, x_, residual_);
    report.residual_after = std::hypot(report.residual_after, norm(residual_));
    report.solver_iterations += cycles_;
    d_ = x_.topRows<3>().transpose().cast<double>();
    poll_progress();
}

bool PaperFlow::is_confined(const Coefficients& displacement) const {
    Eigen::AlignedBox3d box;
    const auto position = [&](const VertexLocation& vertex) -> Eigen::Vector3d {
        return cell_at(elements_.finest().cells[vertex.element]).cast<double>() + vertex.local;
    };
    const auto is_used = [](const VertexLocation& vertex) {
        return vertex.element != VertexLocation::kNoElement;
    };
    for (const VertexLocation& vertex : elements_.vertices) {
        if (is_used(vertex)) box.extend(position(vertex));
    }
    const double margin = kMostOutside * box.diagonal().norm();
    const Eigen::AlignedBox3d wide(box.min().array() - margin, box.max().array() + margin);
    // Written so that a NaN is outside.
    return std::all_of(elements_.vertices.begin(), elements_.vertices.end(),
                       [&](const VertexLocation& vertex) {
                           return !is_used(vertex) ||
                                  wide.contains(position(vertex) +
                                                evaluate_vertex(elements_, displacement, vertex));
                       });
}

void PaperFlow::take_last_step_back() {
    displacement_ = std::move(before_);
}

void PaperFlow::move_vertices(std::vector<Eigen::Vector3d>& positions) const {
    add_at_vertices(elements_, displacement_, positions);
}

std::vector<double> PaperFlow::mean_curvatures(const Positions& after) {
    Positions moved(surface_.mesh_vertices.size());
    parallel_for_rows(surface_.stars.count(), [&](std::int32_t vertex) {
        moved[vertex] =
            (after[surface_.mesh_vertices[vertex]] - surface_.box.center()) / surface_.edge;
    });
    return mean_curvatures_of(surface_, moved);
}

}  // namespace tracked_mcf
