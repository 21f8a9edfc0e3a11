// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/flow.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "filter_tracked_mcf/core/elements/components.h"
#include "filter_tracked_mcf/core/flow/drift.h"
#include "filter_tracked_mcf/core/memory/memory_check.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/octree/automatic_depth.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"
#include "filter_tracked_mcf/core/parallel/setup_phases.h"
#include "filter_tracked_mcf/core/parallel/stopwatch.h"

namespace tracked_mcf {

namespace {

/// The fraction of a step's time before the solver begins.
constexpr double kAssemblyShare = 0.45;

/// Beyond this δ, in squared sides of a cell, single precision loses the mass matrix beside δ S,
/// and with it the location of a closed surface.
constexpr double kLargestStepSizeInCells = 1e5;

/// Beyond this error, relative to its solution, a solve has reached nothing.
constexpr double kNothingReached = 0.5;

/// The numbers of parts in which a step that has failed is made again.
constexpr int kParts[] = {1, 4, 16};

/// Returns the greatest step size, in squared sides of a cell. A step size that follows the local
/// edge length is greatest where the density is smallest.
double largest_step_size(const std::vector<float>& densities) {
    const auto smallest = std::min_element(densities.begin(), densities.end());
    return kLargestStepSizeInCells * (smallest == densities.end() ? 1.0 : double{*smallest});
}

/// Returns the step size that the parameters ask for, in squared sides of a cell.
double in_cells(const FlowParameters& parameters, const Domain& domain, const Grid& grid) {
    if (parameters.step_size > 0) {
        const double unit = parameters.absolute ? 1 : longest_side(domain.mesh());
        const double cells = unit / grid.cell_size;
        return parameters.step_size * cells * cells;
    }
    const double detail_size = parameters.detail_size > 0
                                   ? parameters.detail_size
                                   : kDefaultDetailInEdges * mean_edge_length(domain.surface());
    return step_size_for(detail_size / grid.cell_size, parameters.iterations, parameters.order);
}

}  // namespace

struct Flow::Start {
    ClippedSurface surface;
    double estimated_bytes;
};

Flow::Start Flow::start(const Domain& domain, const FlowParameters& parameters,
                        const std::optional<Grid>& grid) {
    if (!grid) enter_setup_phase(kChooseGrid);
    const Grid cube = grid ? *grid : enclosing_grid(domain.surface(), parameters.depth);
    const MemoryCheck memory = check_of(domain, cube, parameters);
    // Depth 0 asks for the automatic depth.
    if (cube.depth == 0) {
        ClippedSurface surface = clip_at_automatic_depth(
            domain.surface(), cube, count_vertices(domain.topology()),
            [&](int depth) { return memory.separate_unknowns(depth); },
            [&](int depth) { memory.before_clipping(depth); });
        const int depth = surface.grid.depth;
        memory.before_flow(depth);
        return {std::move(surface), memory.flow_bytes(depth)};
    }
    memory.before_flow(cube.depth);
    enter_setup_phase(kClipTriangles);
    return {clip_to_grid(domain.surface(), cube), memory.flow_bytes(cube.depth)};
}

Flow::Flow(const Domain& domain, const FlowParameters& parameters, const std::optional<Grid>& grid)
    : Flow(domain, parameters, start(domain, parameters, grid)) {}

Flow::Flow(const TriangleMesh& mesh, const FlowParameters& parameters,
           const std::optional<Grid>& grid)
    : Flow(Domain(mesh, parameters.boundary), parameters, grid) {}

Flow::Flow(const Domain& domain, const FlowParameters& parameters, Start start)
    : parameters_(parameters),
      elements_(build_tracked_elements(domain, std::move(start.surface), parameters)),
      component_of_(components_of(elements_)),
      step_size_in_cells_(std::min(in_cells(parameters, domain, elements_.grid),
                                   largest_step_size(elements_.densities))),
      solver_(make_step_solver(elements_, parameters)),
      stabilization_(elements_),
      curve_constraint_(elements_, parameters.boundary_penalty),
      confinement_(
          elements_, component_of_,
          parameters.order == 1 ? 0 : detail_size_for(step_size_in_cells_, 1, parameters.order)),
      displacement_(Coefficients::Zero(elements_.finest().unknown_count(), 3)),
      solutions_(parameters.order) {
    fill_report(domain);
    report_.estimated_memory_bytes = static_cast<std::int64_t>(start.estimated_bytes);
    if (parameters.flow == FlowKind::Conformalized) vanished_components_.emplace(elements_);
    // With the stabilisation, functions that hardly meet the surface follow those that do.
    if (stabilization_of(parameters) == 0) constrain_negligible(supports(), solver_->constrained());
}

void Flow::fill_report(const Domain& domain) {
    report_.vertices = elements_.referenced_vertex_count;
    report_.triangles = static_cast<std::int64_t>(domain.surface().triangles.size());
    report_.degenerate_triangles = elements_.degenerate_triangle_count;
    report_.boundary_edges = domain.boundary_edge_count();
    report_.constrained_vertices = elements_.constrained_vertex_count;
    report_.depth = elements_.grid.depth;
    report_.cell_size = elements_.grid.cell_size;
    const double squared_cell = report_.cell_size * report_.cell_size;
    report_.step_size = step_size_in_cells_ * squared_cell;
    report_.asked_step_size = in_cells(parameters_, domain, elements_.grid) * squared_cell;
    report_.detail_size =
        detail_size_for(report_.step_size, parameters_.iterations, parameters_.order);
    report_.cells = count_cells(elements_.finest());
    report_.elements = elements_.finest().element_count();
    report_.unknowns = elements_.finest().unknown_count();
    report_.constrained_unknowns =
        std::count(solver_->constrained().begin(), solver_->constrained().end(), 1);
    report_.fragments = elements_.fragment_count;
    report_.split_triangles = elements_.split_triangle_count;
    report_.samples = static_cast<std::int64_t>(elements_.samples.size());
}

bool Flow::step() {
    if (updates_multipliers() && !report_.steps.empty()) {
        curve_constraint_.update_multipliers(displacement_);
    }
    StepReport report;
    const Stopwatch assembling;
    prepare(step_size_in_cells_);
    report.assemble_seconds = assembling.seconds();
    report.area = systems_.area * elements_.grid.cell_size * elements_.grid.cell_size;
    report.collapsed_samples = systems_.collapsed_samples;

    const ProgressSpan solving(kAssemblyShare, 1);
    if (ends_here(report)) return false;
    const Stopwatch stopwatch;
    tolerance_ = parameters_.tolerance;
    solve(report);  // A d = b, and again for a greater order
    add();          // x(t+δ) = x(t) + d
    bool success = succeeded(report);
    for (const int parts : kParts) success = success || repeat(parts, report);
    report.solve_seconds = stopwatch.seconds();
    report_.steps.push_back(report);
    if (!success) undo_step(Stop::StepFailed);
    return success;
}

void Flow::prepare(double delta) {
    assemble(delta);              // A = D + δS, b = -δ S x(t)
    add_curve_constraint(delta);  // A += δη C, b += δ (n + λ) - δη C u
    stabilize(delta);             // A += κ (δ + 0.1) N
    constrain_unknowns(delta);    // constrained unknowns: zero rows and columns of A
}

bool Flow::succeeded(const StepReport& report) const {
    const bool reached = report.reached_tolerance || report.error_estimate <= kNothingReached;
    return reached && confinement_.holds(displacement_);
}

bool Flow::repeat(int parts, StepReport& report) {
    displacement_ = previous_;
    prediction_ = {};  // that of the whole step
    solutions_.assign(solutions_.size(), {});
    report.residual_before = report.residual_after = report.error_estimate = 0;
    report.reached_tolerance = true;
    tolerance_ = std::min(parameters_.tolerance, kCarefulTolerance);
    const std::vector<std::uint8_t> constrained = constrained_components();
    ElementSystems masses;
    for (int i = 0; i < parts; ++i) {
        if (updates_multipliers() && i > 0) curve_constraint_.update_multipliers(displacement_);
        prepare(step_size_in_cells_ / parts);
        if (!solver_->has_free_unknowns()) break;
        solve(report);
        report.reached_tolerance = report.error_estimate <= parameters_.tolerance;
        Coefficients step = step_of(parameters_.order);
        assemble_elements(elements_, displacement_, {1.0F, 0.0F, parameters_.flow, false}, masses);
        remove_drift(elements_, component_of_, masses.matrices, constrained, step);
        displacement_ += step;
        if (parameters_.quality == Quality::MeanCurvature) last_step_ = parts * step_of(1);
        if (!succeeded(report)) return false;
    }
    return true;
}

std::vector<std::uint8_t> Flow::constrained_components() const {
    std::vector<std::uint8_t> constrained(static_cast<std::size_t>(component_count(elements_)), 0);
    for_each_unknown(elements_, component_of_, [&](std::int32_t unknown, std::int32_t component) {
        if (solver_->constrained()[unknown] != 0) constrained[component] = 1;
    });
    for (const CurveSample& sample : elements_.curve_samples) {
        if (constrains_curve()) constrained[component_of_[sample.element]] = 1;
    }
    return constrained;
}

void Flow::assemble(double delta) {
    assemble_elements(elements_, displacement_,
                      {1.0F, static_cast<float>(delta), parameters_.flow, parameters_.order > 1},
                      systems_);
    if (predicts()) {
        multiply(elements_, systems_.matrices, prediction_.embedding, prediction_.products);
    }
}

void Flow::add_curve_constraint(double delta) {
    if (constrains_curve()) curve_constraint_.add(displacement_, delta, systems_);
}

void Flow::stabilize(double delta) {
    stabilization_.add(stabilization_of(parameters_), delta, systems_.matrices);
}

void Flow::constrain_unknowns(double delta) {
    if (parameters_.constrain_pinches && parameters_.flow == FlowKind::Conformalized) {
        vanished_components_->constrain(systems_, kVanishedArea, solver_->constrained());
    } else if (parameters_.constrain_pinches && !systems_.collapses.empty()) {
        const bool converged = parameters_.solver == Solver::Converged;
        constrain_pinched(elements_, supports(), systems_,
                          converged ? kPinchedShareConverged : kPinchedShareOneWCycle,
                          solver_->constrained());
    }
    solver_->take(systems_.matrices, systems_.area, delta);
}

const Supports& Flow::supports() {
    if (!supports_) supports_ = measure_supports(elements_);
    return *supports_;
}

bool Flow::ends_here(const StepReport& report) {
    if (!report_.steps.empty() && report.area <= kVanishedArea * report_.steps.front().area) {
        undo_step(Stop::Vanished);
        return true;
    }
    if (report_.constrained_vertices == report_.vertices || !solver_->has_free_unknowns()) {
        report_.stop = Stop::NothingMoves;
        return true;
    }
    return false;
}

void Flow::solve(StepReport& report) {
    for (int i = 0; i < parameters_.order; ++i) {
        const ProgressSpan span(1.0 * i / parameters_.order, (i + 1.0) / parameters_.order);
        // A d = δ S d', where d' is the displacement of a step of one order less
        if (i > 0) multiply(elements_, systems_.stiffnesses, step_of(i), systems_.right_sides);
        if (predicts()) subtract_prediction(i + 1);
        solve(solutions_[i], report);
    }
}

double Flow::Prediction::loss(std::int32_t component, int order, int all_orders) const {
    const double loss = losses[component];
    return std::copysign(std::pow(std::abs(loss), double(order) / all_orders), loss);
}

void Flow::subtract_prediction(int order) {
    parallel_for_rows(elements_.finest().element_count(), [&](std::int32_t element) {
        const auto loss =
            static_cast<float>(prediction_.loss(component_of_[element], order, parameters_.order));
        for (int axis = 0; axis < 3; ++axis) {
            for (int row = 0; row < 8; ++row) {
                systems_.right_sides[element].entry[axis][row] +=
                    loss * prediction_.products[element].entry[axis][row];
            }
        }
    });
}

/// Returns the displacement of a step of this order, at most that of the flow.
Coefficients Flow::step_of(int order) const {
    Coefficients step = solutions_[order - 1].x;
    if (!predicts()) return step;
    for_each_unknown(elements_, component_of_, [&](std::int32_t unknown, std::int32_t component) {
        step.row(unknown) -= prediction_.loss(component, order, parameters_.order) *
                             prediction_.embedding.row(unknown);
    });
    return step;
}

void Flow::solve(Solution& solution, StepReport& report) {
    solver_->solve(systems_.right_sides, tolerance_, solution, report);
}

void Flow::add() {
    previous_ = displacement_;
    poll_progress();
    displacement_ += step_of(parameters_.order);
    if (parameters_.quality == Quality::MeanCurvature) last_step_ = step_of(1);
}

void Flow::undo_step(Stop reason) {
    if (report_.steps.empty()) return;
    displacement_ = previous_;
    report_.steps.pop_back();
    report_.stop = reason;
}

void Flow::scale(const std::vector<Scaling>& components) {
    prediction_.embedding = identity_coefficients(elements_);
    prediction_.losses.clear();
    for (const Scaling& component : components) {
        prediction_.losses.push_back(1 - 1 / component.factor);
    }
    poll_progress();
    for_each_unknown(elements_, component_of_, [&](std::int32_t unknown, std::int32_t component) {
        const auto& [centre, factor] = components[component];
        auto from_centre = prediction_.embedding.row(unknown);
        from_centre -= elements_.grid.to_grid(centre).transpose();
        auto displacement = displacement_.row(unknown);
        displacement = factor * displacement + (factor - 1) * from_centre;
        from_centre += displacement;
    });
    confinement_.move_to(displacement_);
}

const Coefficients& Flow::pressure_response() {
    const Stopwatch stopwatch;
    integrate_normals(elements_, previous_, systems_.right_sides);
    solve(pressure_response_, report_.steps.back());
    report_.steps.back().solve_seconds += stopwatch.seconds();
    return pressure_response_.x;
}

void Flow::inflate(const std::vector<double>& factors) {
    poll_progress();
    for_each_unknown(elements_, component_of_, [&](std::int32_t unknown, std::int32_t component) {
        displacement_.row(unknown) += factors[component] * pressure_response_.x.row(unknown);
    });
    confinement_.move_to(displacement_);
}

void Flow::add_at_vertices(const Coefficients& coefficients,
                           std::vector<Eigen::Vector3d>& vectors) const {
    const auto add_at = [&](std::int64_t vertex) {
        const VertexLocation& location = elements_.vertices[vertex];
        if (location.element == VertexLocation::kNoElement) return;
        if (elements_.vertex_constrained[vertex] != 0) return;
        const Eigen::Vector3d added =
            elements_.grid.cell_size * evaluate_vertex(elements_, coefficients, location);
        if (!added.isZero(0)) vectors[vertex] += added;
    };
    parallel_for_blocks(static_cast<std::int64_t>(vectors.size()),
                        [&](std::int64_t begin, std::int64_t end) {
                            for (std::int64_t vertex = begin; vertex < end; ++vertex)
                                add_at(vertex);
                        });
}

void Flow::move_vertices(std::vector<Eigen::Vector3d>& positions) const {
    add_at_vertices(displacement_, positions);
}

std::vector<Eigen::Vector3d> Flow::velocities(std::size_t vertex_count) const {
    std::vector<Eigen::Vector3d> velocities(vertex_count, Eigen::Vector3d::Zero());
    if (last_step_.size() == 0) return velocities;
    add_at_vertices(last_step_ / report_.step_size, velocities);
    if (elements_.densities.empty()) return velocities;
    for (std::size_t vertex = 0; vertex < vertex_count; ++vertex) {
        const std::int32_t element = elements_.vertices[vertex].element;
        if (element != VertexLocation::kNoElement)
            velocities[vertex] *= elements_.densities[element];
    }
    return velocities;
}

}  // namespace tracked_mcf
