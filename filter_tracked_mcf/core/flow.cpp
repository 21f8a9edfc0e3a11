#include "filter_tracked_mcf/core/flow.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "filter_tracked_mcf/core/automatic_depth.h"
#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/memory_check.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/pinches.h"
#include "filter_tracked_mcf/core/progress_meter.h"
#include "filter_tracked_mcf/core/setup_phases.h"
#include "filter_tracked_mcf/core/stopwatch.h"

namespace tracked_mcf {

namespace {

/// Of a step's time, what assembly takes.
constexpr double kAssemblyShare = 0.45;

Domain domain_of(const TriangleMesh& mesh, const Selection& selection,
                 const FlowParameters& parameters) {
    enter_setup_phase(SetupPhase::FindEdges);
    return {mesh, selection, parameters.boundary};
}

/// In grid units. Beyond, single precision loses the mass matrix beside δ S, and with it where a
/// closed surface is.
constexpr double kLargestStepSize = 1e5;

/// δ is given for the model scaled to longest side 1, or in squared mesh units.
double to_grid_units(const FlowParameters& parameters, const TriangleMesh& mesh, const Grid& grid) {
    const double unit = parameters.absolute ? 1 : longest_side(mesh);
    const double cells = unit / grid.cell_size;
    return std::min(parameters.step_size * cells * cells, kLargestStepSize);
}

std::unique_ptr<StepSolver> solver_for(const TrackedElements& elements,
                                       const FlowParameters& parameters) {
    enter_setup_phase(SetupPhase::PrepareSolver);
    return make_step_solver(elements, parameters);
}

float pinched_share(Solver solver) {
    return solver == Solver::Converged ? kPinchedShareConverged : kPinchedShareOneWCycle;
}

bool all_finite(const Coefficients& coefficients) {
    // A sum is finite only if every term is, and needs no branch for each.
    return std::isfinite(coefficients.squaredNorm());
}

}  // namespace

struct Flow::Start {
    ClippedSurface surface;
    double estimated_bytes;
};

/// On the grid of the parameters' depth, 0 being automatic, that encloses the mesh.
Flow::Start Flow::start(const TriangleMesh& mesh, const Domain& domain,
                        const FlowParameters& parameters) {
    enter_setup_phase(SetupPhase::ChooseGrid);
    const Grid cube = enclosing_grid(mesh, 0);
    if (parameters.depth > 0) return start(domain, parameters, with_depth(cube, parameters.depth));
    const MemoryCheck memory = check_of(domain, cube, parameters);
    ClippedSurface surface =
        clip_at_automatic_depth(domain.surface(), cube, count_vertices(domain.topology()),
                                [&](int depth) { memory.before_clipping(depth); });
    const int depth = surface.grid.depth;
    memory.before_flow(depth);
    return {std::move(surface), memory.flow_bytes(depth)};
}

Flow::Start Flow::start(const Domain& domain, const FlowParameters& parameters, const Grid& grid) {
    const MemoryCheck memory = check_of(domain, grid, parameters);
    memory.before_flow(grid.depth);
    enter_setup_phase(SetupPhase::ClipTriangles);
    return {clip_to_grid(domain.surface(), grid), memory.flow_bytes(grid.depth)};
}

Flow::Flow(const TriangleMesh& mesh, const FlowParameters& parameters, const Selection& selection)
    : Flow(mesh, domain_of(mesh, selection, parameters), parameters) {}

Flow::Flow(const TriangleMesh& mesh, const FlowParameters& parameters, const Grid& grid,
           const Selection& selection)
    : Flow(mesh, domain_of(mesh, selection, parameters), parameters, grid) {}

Flow::Flow(const TriangleMesh& mesh, const Domain& domain, const FlowParameters& parameters)
    : Flow(mesh, domain, parameters, start(mesh, domain, parameters)) {}

Flow::Flow(const TriangleMesh& mesh, const Domain& domain, const FlowParameters& parameters,
           const Grid& grid)
    : Flow(mesh, domain, parameters, start(domain, parameters, grid)) {}

Flow::Flow(const TriangleMesh& mesh, const Domain& domain, const FlowParameters& parameters,
           Start start)
    : parameters_(parameters),
      elements_(build_tracked_elements(domain, std::move(start.surface), parameters.cubature,
                                       parameters.separate_sheets)),
      grid_step_size_(to_grid_units(parameters, mesh, elements_.grid)),
      solver_(solver_for(elements_, parameters)),
      stabilization_(elements_),
      held_curve_(elements_, parameters.boundary_spring),
      displacement_(Coefficients::Zero(elements_.finest().unknown_count(), 3)) {
    fill_report(domain);
    report_.estimated_memory_bytes = static_cast<std::int64_t>(start.estimated_bytes);
    if (parameters.flow == FlowKind::Conformalized) vanished_parts_.emplace(elements_);
    // With the stabilisation, functions that hardly meet the surface follow those that do.
    if (stabilization_of(parameters) == 0) freeze_negligible(supports(), solver_->frozen());
}

void Flow::fill_report(const Domain& domain) {
    report_.vertices = elements_.referenced_vertex_count;
    report_.triangles = static_cast<std::int64_t>(domain.surface().triangles.size());
    report_.degenerate_triangles = elements_.degenerate_triangle_count;
    report_.boundary_edges = domain.boundary_edge_count();
    report_.held_vertices = elements_.held_vertex_count;
    report_.depth = elements_.grid.depth;
    report_.cell_size = elements_.grid.cell_size;
    report_.cells = count_cells(elements_.finest());
    report_.elements = elements_.finest().element_count();
    report_.unknowns = elements_.finest().unknown_count();
    report_.locked_unknowns = std::count(solver_->frozen().begin(), solver_->frozen().end(), 1);
    report_.fragments = elements_.fragment_count;
    report_.split_triangles = elements_.split_triangle_count;
    report_.samples = static_cast<std::int64_t>(elements_.samples.size());
}

bool Flow::step() {
    StepReport report;
    assemble(report);
    const ProgressSpan solving(kAssemblyShare, 1);
    if (!report_.steps.empty() && report.area <= kVanishedArea * report_.steps.front().area) {
        take_back(Stop::Vanished);
        return false;
    }
    if (!can_move()) {
        report_.stop = Stop::NothingMoves;
        return false;
    }
    solve(report);
    report_.steps.push_back(report);
    return true;
}

void Flow::take_back(Stop reason) {
    if (report_.steps.empty()) return;
    displacement_ = previous_;
    report_.steps.pop_back();
    report_.stop = reason;
}

bool Flow::can_move() const {
    return report_.held_vertices != report_.vertices && solver_->can_move();
}

void Flow::scale(const Eigen::Vector3d& centre, double factor) {
    const Eigen::RowVector3d fixed = elements_.grid.to_grid(centre).transpose();
    const Coefficients from_centre = identity_coefficients(elements_).rowwise() - fixed;
    poll_progress();
    displacement_ = factor * displacement_ + (factor - 1) * from_centre;
    poll_progress();
    guess_ = (1 / factor - 1) * (from_centre + displacement_);
}

void Flow::assemble(StepReport& report) {
    const Stopwatch stopwatch;
    assemble_elements(elements_, displacement_,
                      {1.0F, static_cast<float>(grid_step_size_), parameters_.flow}, systems_);
    if (guess_.size() > 0) subtract_guess(elements_, guess_, systems_);
    if (holds_curve()) held_curve_.add(displacement_, grid_step_size_, systems_);
    stabilization_.add(stabilization_of(parameters_), grid_step_size_, systems_.matrices);
    if (parameters_.anchor_pinches) anchor_what_has_pinched();
    solver_->take(systems_, grid_step_size_);
    report.area = systems_.area * elements_.grid.cell_size * elements_.grid.cell_size;
    report.collapsed_samples = systems_.collapsed_samples;
    report.assemble_seconds = stopwatch.seconds();
}

void Flow::anchor_what_has_pinched() {
    if (parameters_.flow == FlowKind::Conformalized) {
        vanished_parts_->freeze(systems_, kVanishedArea, solver_->frozen());
    } else if (!systems_.collapses.empty()) {
        freeze_pinched(elements_, supports(), systems_, pinched_share(parameters_.solver),
                       solver_->frozen());
    }
}

const Supports& Flow::supports() {
    if (!supports_) supports_ = measure_supports(elements_);
    return *supports_;
}

void Flow::solve(StepReport& report) {
    const Stopwatch stopwatch;
    solver_->solve(solution_, report);
    // Conjugate gradients leave the solution at zero if the system is not finite.
    if (!all_finite(solution_) || !std::isfinite(report.relative_residual)) {
        throw NumericalFailure(
            "The flow broke down: its numbers are no longer finite. Use a smaller step size or "
            "fewer iterations.");
    }
    previous_ = displacement_;
    poll_progress();
    displacement_ += solution_;
    if (guess_.size() > 0) displacement_ += guess_;
    if (holds_curve() && parameters_.take_up_boundary) held_curve_.take_up(displacement_);
    report.solve_seconds = stopwatch.seconds();
}

void Flow::move_vertices(TriangleMesh& mesh) const {
    parallel_for_blocks(static_cast<std::int64_t>(mesh.positions.size()), [&](std::int64_t begin,
                                                                              std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
            const VertexPlace& place = elements_.vertices[i];
            if (place.element == VertexPlace::kNowhere || elements_.vertex_held[i] != 0) continue;
            const Eigen::Vector3d moved =
                elements_.grid.cell_size * evaluate_vertex(elements_, displacement_, place);
            if (!moved.isZero(0)) mesh.positions[i] += moved;
        }
    });
}

}  // namespace tracked_mcf
