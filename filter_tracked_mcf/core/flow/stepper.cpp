// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/stepper.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "filter_tracked_mcf/core/flow/drift.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"
#include "filter_tracked_mcf/core/parallel/setup_phases.h"
#include "filter_tracked_mcf/core/parallel/stopwatch.h"
#include "filter_tracked_mcf/core/system/constrained_cells.h"

namespace tracked_mcf {

namespace {

/// The fraction of a step's time before the solver begins.
constexpr double kAssemblyShare = 0.45;

/// Beyond this δ, in squared sides of a cell, single precision loses the mass matrix beside δ S,
/// and with it the location of a closed surface.
constexpr double kLargestStepSizeInCells = 1e5;

/// A solve whose error is more than this part of its solution has failed.
constexpr double kNothingReached = 0.5;

/// Returns the greatest step size, in squared sides of a cell. A step size that follows the local
/// edge length is greatest where the density is smallest.
double largest_step_size(const std::vector<float>& densities) {
    const auto smallest = std::min_element(densities.begin(), densities.end());
    return kLargestStepSizeInCells * (smallest == densities.end() ? 1.0 : double{*smallest});
}

}  // namespace

Stepper::Stepper(TrackedElements elements, const StepPlan& plan)
    : plan_(plan),
      elements_(std::move(elements)),
      size_(in_cells(std::min(plan.size.in_cells, largest_step_size(elements_.densities)),
                     elements_.grid)),
      stabilization_(elements_),
      curve_constraint_(elements_),
      confinement_(elements_, plan.order == 1 ? 0 : detail_size_for(size_.in_cells, 1, plan.order)),
      solutions_(plan.order) {
    enter_setup_phase(kPrepareSolver);
    auto constrained = constrained_unknowns(elements_, plan.boundary);
    initially_constrained_ = constrained.back();
    locked_unknown_count_ =
        std::count(initially_constrained_.begin(), initially_constrained_.end(), 1);
    solver_ = make_step_solver(elements_, std::move(constrained), plan.cycles);
    if (plan.flow == FlowKind::Conformalized) vanished_components_.emplace(elements_);
    // With the stabilisation, functions that hardly meet the surface follow those that do.
    if (plan.stabilization == 0) constrain_negligible(supports(), initially_constrained_);
}

FlowState Stepper::start() const {
    FlowState state;
    state.displacement = Coefficients::Zero(elements_.finest().unknown_count(), 3);
    state.multipliers = curve_constraint_.zero_multipliers();
    state.constrained = initially_constrained_;
    return state;
}

StepResult Stepper::advance(const FlowState& from, const StepSize& size, const Care& care,
                            StepReport& report) {
    const double delta = size.in_cells;
    FlowState to;
    to.boxes = from.boxes;
    to.constrained = from.constrained;
    to.multipliers = constrains_curve()
                         ? curve_constraint_.updated(from.multipliers, from.displacement)
                         : from.multipliers;

    const Stopwatch assembling;
    // A = D + δS, b = -δ S x(t)
    assemble_elements(elements_, from.displacement,
                      {1.0F, static_cast<float>(delta), plan_.flow, plan_.order > 1}, systems_);
    report.area = systems_.area * elements_.grid.cell_size * elements_.grid.cell_size;
    report.collapsed_samples = systems_.collapsed_samples;
    to.first_area = from.first_area > 0 ? from.first_area : systems_.area;
    if (systems_.area < kVanishedArea * to.first_area) return Stop::Vanished;
    predict(care.removes_drift ? std::vector<Scaling>() : from.scalings, from.displacement);
    // A += δη C, b += δ (n + λ) - δη C u
    if (constrains_curve()) {
        curve_constraint_.add(from.displacement, to.multipliers, delta, systems_);
    }
    // A += κ (δ + 0.1) N
    stabilization_.add(plan_.stabilization, delta, systems_.matrices);
    // Constrained unknowns: zero rows and columns of A. When a surface shrinks, its mass shrinks
    // and its stiffness does not.
    constrain_pinches(to.constrained);
    solver_->take(systems_.matrices, to.constrained,
                  systems_.area > 0 ? delta * to.first_area / systems_.area : delta);
    report.assemble_seconds += assembling.seconds();

    const ProgressSpan solving(kAssemblyShare, 1);
    if (elements_.constrained_vertex_count == elements_.referenced_vertex_count ||
        !solver_->has_free_unknowns()) {
        return Stop::NothingMoves;
    }
    const Stopwatch stopwatch;
    solve(care.tolerance, report);  // A d = b, and again for a greater order
    report.reached_tolerance = report.error_estimate <= plan_.tolerance;
    poll_progress();
    to.displacement = step_of(plan_.order);
    if (care.removes_drift) remove_drift_from(to.displacement, from, to.constrained);
    to.displacement += from.displacement;  // x(t+δ) = x(t) + d
    if (plan_.takes_velocities) {
        to.velocity = step_of(1) / size.in_mesh_units;
    }
    report.solve_seconds += stopwatch.seconds();
    const bool reached = report.reached_tolerance || report.error_estimate <= kNothingReached;
    if (!reached || !confinement_.holds(to.displacement, to.boxes)) return Stop::StepFailed;
    if (plan_.takes_responses) respond(from, care.tolerance, report);
    return to;
}

void Stepper::predict(const std::vector<Scaling>& scalings, const Coefficients& displacement) {
    prediction_.embedding.resize(0, 3);
    if (scalings.empty()) return;
    prediction_.losses.clear();
    for (const Scaling& scaling : scalings) prediction_.losses.push_back(1 - 1 / scaling.factor);
    prediction_.embedding = identity_coefficients(elements_);
    parallel_for_rows(elements_.finest().unknown_count(), [&](std::int32_t unknown) {
        const Scaling& scaling = scalings[elements_.components.of_unknown[unknown]];
        auto from_centre = prediction_.embedding.row(unknown);
        from_centre -= elements_.grid.to_grid(scaling.centre).transpose();
        from_centre += displacement.row(unknown);
    });
    multiply(elements_, systems_.matrices, prediction_.embedding, prediction_.products);
}

void Stepper::constrain_pinches(std::vector<std::uint8_t>& constrained) {
    if (!plan_.constrain_pinches) return;
    if (vanished_components_) {
        vanished_components_->constrain(systems_, kVanishedArea, constrained);
    } else if (!systems_.collapses.empty()) {
        const bool converged = plan_.cycles == 0;
        constrain_pinched(elements_, supports(), systems_,
                          converged ? kPinchedShareConverged : kPinchedShareOneWCycle, constrained);
    }
}

const Supports& Stepper::supports() {
    if (!supports_) supports_ = measure_supports(elements_);
    return *supports_;
}

void Stepper::solve(double tolerance, StepReport& report) {
    for (int i = 0; i < plan_.order; ++i) {
        const ProgressSpan span(1.0 * i / plan_.order, (i + 1.0) / plan_.order);
        // A d = δ S d', where d' is the displacement of a step of one order less
        if (i > 0) multiply(elements_, systems_.stiffnesses, step_of(i), systems_.right_sides);
        if (predicts()) subtract_prediction(i + 1);
        solver_->solve(systems_.right_sides, tolerance, solutions_[i], report);
    }
}

double Stepper::Prediction::loss(std::int32_t component, int order, int all_orders) const {
    const double loss = losses[component];
    return std::copysign(std::pow(std::abs(loss), double(order) / all_orders), loss);
}

void Stepper::subtract_prediction(int order) {
    parallel_for_rows(elements_.finest().element_count(), [&](std::int32_t element) {
        const auto loss = static_cast<float>(
            prediction_.loss(elements_.components.of_element[element], order, plan_.order));
        for (int axis = 0; axis < 3; ++axis) {
            for (int row = 0; row < 8; ++row) {
                systems_.right_sides[element].entry[axis][row] +=
                    loss * prediction_.products[element].entry[axis][row];
            }
        }
    });
}

Coefficients Stepper::step_of(int order) const {
    Coefficients step = solutions_[order - 1].x;
    if (!predicts()) return step;
    parallel_for_rows(elements_.finest().unknown_count(), [&](std::int32_t unknown) {
        const std::int32_t component = elements_.components.of_unknown[unknown];
        step.row(unknown) -=
            prediction_.loss(component, order, plan_.order) * prediction_.embedding.row(unknown);
    });
    return step;
}

void Stepper::remove_drift_from(Coefficients& step, const FlowState& from,
                                const std::vector<std::uint8_t>& constrained) const {
    // Flags of the components that a boundary or a constrained unknown holds.
    std::vector<std::uint8_t> held(static_cast<std::size_t>(elements_.components.count), 0);
    for (std::size_t unknown = 0; unknown < constrained.size(); ++unknown) {
        if (constrained[unknown] != 0) held[elements_.components.of_unknown[unknown]] = 1;
    }
    for (const CurveSample& sample : elements_.curve_samples) {
        if (constrains_curve()) held[elements_.components.of_element[sample.element]] = 1;
    }
    ElementSystems masses;
    assemble_elements(elements_, from.displacement, {1.0F, 0.0F, plan_.flow, false}, masses);
    remove_drift(elements_, masses.matrices, held, step);
}

void Stepper::respond(const FlowState& from, double tolerance, StepReport& report) {
    const Stopwatch stopwatch;
    assemble_normals(elements_, from.displacement, systems_.right_sides);
    solver_->solve(systems_.right_sides, tolerance, pressure_response_, report);
    report.reached_tolerance = report.error_estimate <= plan_.tolerance;
    report.solve_seconds += stopwatch.seconds();
}

}  // namespace tracked_mcf
