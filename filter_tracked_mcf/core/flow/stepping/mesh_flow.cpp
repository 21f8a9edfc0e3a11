// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/stepping/mesh_flow.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "filter_tracked_mcf/core/flow/plan/densities.h"
#include "filter_tracked_mcf/core/flow/plan/setup_phases.h"
#include "filter_tracked_mcf/core/flow/stepping/mean_curvature.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/mesh/triangle_elements.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"
#include "filter_tracked_mcf/core/parallel/stopwatch.h"

namespace tracked_mcf {

namespace {

/// The fraction of a step's time before the solver begins.
constexpr double kShareOfAssembly = 0.2;

/// The area after a step may be so many times that before it.
constexpr double kMostGrowth = 1.001;

/// What rounding adds to a triangle's area, in squared edges: a strip may be so narrow that its own
/// area is less.
constexpr double kRoundedArea = 1e-6;

/// A solve whose error is more than this part of its solution has failed.
constexpr double kUseless = 0.5;

/// The tolerance where parts are scaled after the step, relative to the usual one.
constexpr double kToleranceOfScaled = 0.1;

/// A step of order 2 or more overshoots at corners. It may leave the box of the surface by this
/// part of the length of the waves that it halves and of the box's diagonal.
constexpr double kOvershootInDetail = 0.1, kOvershootInDiagonals = 0.02;

/// Where waves are shorter than this, in edges, coarser functions than the mesh's cost more than
/// they save.
constexpr double kShortWaves = 16;

/// An octree is used from a step on whose solves take more iterations than this.
constexpr int kManyIterations = 30;

/// The side of the octree's cells is at least this, in edges.
constexpr double kSmallestCell = 3;

/// The octree is built anew if the first step leaves less than this part of the area. Vertices that
/// were apart, as those of noise, have come together then, and its functions jump between them.
constexpr double kSameShape = 0.95;

/// Not if the new one would have less than this part of the first one's elements: parts that shrink
/// to a point need the functions that they had.
constexpr double kFewerElements = 0.25;

/// Parts of fewer vertices use no octree: all of their waves are short.
constexpr std::int32_t kFewestForOctree = 64;

/// The octree has at most this share of the vertices as elements.
constexpr double kMostElements = 0.25;

/// Returns the box of each part.
std::vector<Eigen::AlignedBox3d> boxes_of(const Surface& surface, const Positions& positions) {
    std::vector<Eigen::AlignedBox3d> boxes(static_cast<std::size_t>(surface.part_count));
    for (std::size_t i = 0; i < positions.size(); ++i) boxes[surface.parts[i]].extend(positions[i]);
    return boxes;
}

/// Returns a box that is larger on all sides.
Eigen::AlignedBox3d widened(const Eigen::AlignedBox3d& box, double margin) {
    return {box.min().array() - margin, box.max().array() + margin};
}

/// Returns an octree for the parts at these positions that have enough vertices; none if there are
/// no such parts, or if an octree is of no use to them. A depth of 0 chooses it.
std::unique_ptr<VertexOctree> octree_of(const Surface& surface, const Positions& positions,
                                        int depth) {
    std::vector<std::int32_t> sizes(static_cast<std::size_t>(surface.part_count), 0);
    for (const std::int32_t part : surface.parts) ++sizes[part];
    std::vector<std::uint8_t> has_functions(positions.size());
    Eigen::AlignedBox3d box;
    std::int32_t count = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (sizes[surface.parts[i]] < kFewestForOctree) continue;
        has_functions[i] = 1;
        box.extend(positions[i]);
        ++count;
    }
    if (count == 0) return nullptr;
    const Grid cube = cube_around(box);
    const auto of_depth = [&](int levels) {
        return std::make_unique<VertexOctree>(surface.stars, positions, with_depth(cube, levels),
                                              has_functions);
    };
    if (depth > 0) return of_depth(depth);
    const double finest = std::floor(std::log2(cube.cell_size / kSmallestCell));
    for (int l = static_cast<int>(std::min(finest, double{kMaximumDepth})); l >= 1; --l) {
        auto octree = of_depth(l);
        if (octree->finest().element_count() <= kMostElements * count) return octree;
    }
    return nullptr;
}

}  // namespace

MeshFlow::MeshFlow(MeshPlan plan)
    : SurfaceFlow(plan),
      steps_(plan.steps),
      step_size_(plan.step_size / (surface_.edge * surface_.edge)),
      depth_(plan.depth),
      densities_(triangle_densities(surface_)),
      positions_(std::move(surface_.positions)),
      solver_(surface_.stars, surface_.held, surface_.parts) {
    first_area_ = area_ = area_of(positions_);
    enter_setup_phase(kBuildOctree);
    if (plan.depth > 0 || detail_size_for(step_size_, 1, steps_.order) >= kShortWaves) {
        use_octree();
    }
    enter_setup_phase(kPrepareSolver);
    Eigen::AlignedBox3d box;
    for (const Eigen::AlignedBox3d& of_part : boxes_of(surface_, positions_)) box.extend(of_part);
    const double diagonal = box.diagonal().norm();
    const double halved = detail_size_for(step_size_, 1, steps_.order);
    margin_ = kOvershootInDetail * std::min(halved, diagonal) + kOvershootInDiagonals * diagonal;
    if (plan.preserve != Preserve::None)
        preserver_.emplace(surface_, mesh_, positions_, plan.preserve, plan.steps.flow);
    if (steps_.flow == FlowKind::Conformalized) report_.genus = surface_.genus();
    report_.unknowns = surface_.stars.count();
}

void MeshFlow::use_octree() {
    std::unique_ptr<VertexOctree> octree = octree_of(surface_, positions_, depth_);
    if (!octree) {
        octree_harms_ = true;
        return;
    }
    const auto elements = octree->finest().element_count();
    if (!solver_.octree()) {
        report_.depth = octree->finest().depth;
        report_.cell_size = octree->cell_size() * surface_.edge;
        report_.cells = count_cells(octree->finest());
        report_.elements = elements;
    }
    if (elements < kFewerElements * static_cast<double>(report_.elements)) return;
    solver_.use(std::move(octree));
}

void MeshFlow::renew_octree() {
    if (report_.steps.empty() || octree_harms_) return;
    // A surface that has shrunk has longer waves, in its edges.
    const bool needs_one = report_.steps.back().solver_iterations > kManyIterations * steps_.order;
    // A conformalized flow keeps its stiffness, which the functions of the start suit.
    const bool is_rough = report_.steps.size() == 1 && area_ < kSameShape * first_area_ &&
                          steps_.flow == FlowKind::MeanCurvature;
    if (solver_.octree() ? is_rough : needs_one) use_octree();
}

double MeshFlow::area_of(const Positions& positions) const {
    const RawVector<Triangle>& triangles = surface_.stars.triangles;
    return parallel_sum(static_cast<std::int64_t>(triangles.size()), 0.0,
                        [&](std::int64_t begin, std::int64_t end) {
                            double sum = 0;
                            for (std::int64_t i = begin; i < end; ++i) {
                                const auto [a, b, c] = corners_of(positions, triangles[i]);
                                sum += twice_vector_area(a, b, c).norm() / 2;
                            }
                            return sum;
                        });
}

void MeshFlow::solve(StepReport& report, Positions* response) {
    // Once parts have been scaled, most of a step is given back, but not its errors.
    const bool scales = preserver_ && !preserver_->pushes() && !report_.steps.empty();
    const double tolerance = (scales ? kToleranceOfScaled : 1) * steps_.tolerance;
    const int solves = steps_.order + (response != nullptr ? 1 : 0);
    const bool had_octree = solver_.octree() != nullptr;
    const auto solve_one = [&](int number, Positions& x) {
        const ProgressSpan span(1.0 * number / solves, (number + 1.0) / solves);
        const MeshConvergence result = solver_.solve(right_side_, tolerance, x);
        report.solver_iterations += result.iterations;
        report.residual_before = std::hypot(report.residual_before, result.residual_before);
        report.residual_after = std::hypot(report.residual_after, result.residual_after);
        report.error_estimate = worse_of(report.error_estimate, result.error_estimate);
    };
    solver_.system().multiply_stiffness(positions_, -1, right_side_);
    for (int i = 0; i < steps_.order; ++i) {
        // A d = δ L d', where d' is the displacement of a step of one order less
        if (i > 0) solver_.system().multiply_stiffness(d_, 1, right_side_);
        solve_one(i, d_);
    }
    if (response != nullptr) {
        preserver_->pressure(positions_, right_side_);
        solve_one(steps_.order, *response);
    }
    report.reached_tolerance = report.error_estimate <= steps_.tolerance;
    octree_harms_ = octree_harms_ || (had_octree && !solver_.octree());
}

bool MeshFlow::displace(Positions& to) const {
    const std::vector<Eigen::AlignedBox3d> boxes = boxes_of(surface_, positions_);
    to.resize(positions_.size());
    // Order 1 obeys a maximum principle for each coordinate, but for the tolerance.
    const bool is_bounded = steps_.order == 1;
    const auto moves_outside = [&](std::int64_t i) {
        const Eigen::AlignedBox3d& box = boxes[surface_.parts[i]];
        to[i] = positions_[i] + d_[i];
        if (!widened(box, margin_).contains(to[i])) return true;
        if (is_bounded) to[i] = to[i].cwiseMax(box.min()).cwiseMin(box.max());
        return false;
    };
    return parallel_count(static_cast<std::int64_t>(to.size()), moves_outside) == 0;
}

Stop MeshFlow::advance(Positions& to, StepReport& report) {
    const Stopwatch assembling;
    report.area = area_ * surface_.edge * surface_.edge;
    if (report_.held_vertices == report_.vertices) return Stop::NothingMoves;
    renew_octree();
    const bool takes_stiffness = steps_.flow == FlowKind::MeanCurvature || report_.steps.empty();
    solver_.take(elements_in_own_metric(surface_.stars, positions_, densities_), step_size_,
                 takes_stiffness);
    report.assemble_seconds = assembling.seconds();
    const ProgressSpan solving(kShareOfAssembly, 1);
    const Stopwatch stopwatch;
    Positions response;
    solve(report, preserver_ && preserver_->pushes() ? &response : nullptr);
    poll_progress();
    report.solve_seconds = stopwatch.seconds();
    if (!report.reached_tolerance && !(report.error_estimate <= kUseless)) return Stop::StepFailed;
    if (!displace(to)) return Stop::StepFailed;
    const Stop restored = preserver_ ? preserver_->restore(response, to) : Stop::None;
    const double area_before = std::exchange(area_, area_of(to));
    if (preserver_) return restored;
    // A step lowers the energy of the metric that it takes, which bounds the area. Only triangles
    // that are longer in that metric can make it larger, also little by little. A conformalized
    // flow keeps its metric.
    const double most =
        steps_.flow == FlowKind::MeanCurvature ? std::min(area_before, first_area_) : first_area_;
    const auto triangles = static_cast<double>(surface_.stars.triangles.size());
    const bool grew = area_ > kMostGrowth * most + kRoundedArea * triangles;
    return grew ? Stop::Grew : Stop::None;
}

bool MeshFlow::step() {
    if (area_ < kVanishedArea * first_area_) {
        end_before_last_step(Stop::Vanished);
        return false;
    }
    StepReport report;
    const Stop stop = advance(before_, report);
    if (stop != Stop::None) {
        report_.stop = stop;
        return false;
    }
    positions_.swap(before_);
    report_.steps.push_back(report);
    return true;
}

void MeshFlow::take_last_step_back() {
    positions_ = std::move(before_);
}

void MeshFlow::move_vertices(Positions& positions) const {
    parallel_for_rows(static_cast<std::int64_t>(positions.size()), [&](std::int32_t i) {
        const std::int32_t vertex = surface_.vertices[i];
        if (vertex < 0 || surface_.held[vertex] != 0) return;
        const Eigen::Vector3d moved = positions_[vertex] - surface_.in_edges(mesh_, vertex);
        if (!moved.isZero(0)) positions[i] += surface_.edge * moved;
    });
}

std::vector<double> MeshFlow::mean_curvatures(const Positions& /*after*/) {
    return mean_curvatures_of(surface_, positions_);
}

}  // namespace tracked_mcf
