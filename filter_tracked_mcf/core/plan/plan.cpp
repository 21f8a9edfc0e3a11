// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/plan/plan.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/memory/process_memory.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/setup_phases.h"
#include "filter_tracked_mcf/core/plan/automatic_depth.h"
#include "filter_tracked_mcf/core/plan/densities.h"
#include "filter_tracked_mcf/core/plan/memory_check.h"

namespace tracked_mcf {

namespace {

/// A surface is flat if its volume is below this fraction of its area to the power 3/2. The
/// fraction of a sphere is 0.09.
constexpr double kFlat = 1e-9;

void check_no_constraints(const Domain& domain, const char* what) {
    if (!domain.has_constraints()) return;
    throw InvalidParameter(
        std::string(what) +
        " would move vertices that must stay: those of a boundary that is not free, those of "
        "unselected faces, and those with strength 0. Preserve the volume of a mean-curvature flow "
        "instead, or free all vertices.");
}

void check_oriented(const Domain& domain) {
    if (domain.topology().is_oriented_consistently()) return;
    throw InvalidMesh(
        "The volume cannot be preserved because the faces are not oriented consistently: some "
        "neighbours disagree about which side is inside. Re-orient all faces coherently first, or "
        "preserve the area.");
}

void check_encloses_volume(const Domain& domain) {
    if (domain.boundary_edge_count() > 0) {
        throw InvalidMesh(
            "A conformalized flow cannot preserve the volume because the surface is "
            "open: " +
            std::to_string(domain.boundary_edge_count()) +
            " edges have only one face. Close the holes first, or preserve the "
            "area.");
    }
    if (!domain.topology().bounds_volume() ||
        std::abs(enclosed_volume(domain.mesh())) <=
            kFlat * std::pow(surface_area(domain.mesh()), 1.5)) {
        throw InvalidMesh(
            "The volume cannot be preserved because the surface encloses none; preserve the area "
            "instead.");
    }
}

/// Returns whether components are scaled to preserve this, instead of pushed along their normals.
bool scales_components(Preserve preserve, FlowKind flow) {
    return preserve == Preserve::Area || flow == FlowKind::Conformalized;
}

/// Throws InvalidParameter or InvalidMesh if the flow cannot preserve this; see
/// FlowParameters::preserve.
void check_preservable(const Domain& domain, Preserve preserve, FlowKind flow) {
    if (preserve == Preserve::None) return;
    if (preserve == Preserve::Area) {
        check_no_constraints(domain, "Preserving the area");
        return;
    }
    check_oriented(domain);
    if (!scales_components(preserve, flow)) return;
    check_no_constraints(domain, "Preserving the volume of a conformalized flow");
    check_encloses_volume(domain);
}

/// Beyond this δ, in squared mean edge lengths, single precision loses the mass beside the
/// stiffness.
constexpr double kLargestStepSizeInEdges = 5e4;

/// Bytes for each vertex and each triangle of a flow on the mesh's own elements, beside the mesh.
constexpr double kBytesPerVertex = 370, kBytesPerTriangle = 120;

/// Returns the step size that the parameters ask for.
StepSize asked_size(const FlowParameters& parameters, const TriangleMesh& mesh, double mean_edge,
                    const Grid& grid) {
    if (parameters.step_size > 0) {
        const double unit = parameters.absolute ? 1 : longest_side(mesh);
        const double cells = unit / grid.cell_size;
        return in_cells(parameters.step_size * cells * cells, grid);
    }
    const double detail_size = detail_size_of(parameters, mean_edge);
    return in_cells(
        step_size_for(detail_size / grid.cell_size, parameters.iterations, parameters.order), grid);
}

}  // namespace

Plan plan_of(const TriangleMesh& mesh, const Inputs& inputs, FlowParameters parameters) {
    enter_setup_phase(kFindEdges);
    Domain domain(mesh, inputs, parameters.boundary);
    enter_setup_phase(kMeasureSurface);
    check_preservable(domain, parameters.preserve, parameters.flow);
    if (domain.constrains_all_vertices()) {
        // Nothing can move. The cheapest set-up is enough to say so.
        parameters.depth = 1;
        parameters.separate_sheets = false;
    }
    enter_setup_phase(kChooseGrid);
    const Grid cube = enclosing_grid(domain.surface(), parameters.depth);
    const SurfaceSize size = size_of(domain);
    const MemoryCheck memory(size, cube, parameters);
    const double mean_edge = mean_edge_length(domain.surface());
    // Who gives a step size knows the grid.
    const int resolving = parameters.step_size > 0
                              ? 0
                              : resolving_depth(std::max(detail_size_of(parameters, mean_edge),
                                                         kFinestDetailInEdges * mean_edge),
                                                mean_edge, cube);
    enter_setup_phase(kClipTriangles);
    const auto clip = [&] {
        // Depth 0 asks for the automatic depth.
        if (cube.depth == 0) return clip_at_automatic_depth(domain, size, cube, resolving, memory);
        memory.before_flow(cube.depth);
        return clip_to_grid(domain.surface(), cube);
    };
    ClippedSurface surface = clip();
    Plan plan = plan_of(std::move(domain), std::move(surface), mean_edge, parameters);
    plan.resolving_depth = resolving;
    plan.expected_bytes = memory.flow_bytes(plan.surface.grid.depth);
    return plan;
}

MeshPlan mesh_plan_of(const TriangleMesh& mesh, const Inputs& inputs,
                      const FlowParameters& parameters) {
    if (parameters.boundary == BoundaryCondition::LockedCells) {
        throw InvalidParameter("boundary",
                               "locks cells, which the default method does not have; lock the "
                               "boundary itself, or take the method paper.");
    }
    const double bytes = kBytesPerVertex * static_cast<double>(mesh.positions.size()) +
                         kBytesPerTriangle * static_cast<double>(mesh.triangles.size());
    check_free_memory(bytes, "The flow", "Simplify the mesh, or take a part of it.");
    enter_setup_phase(kFindEdges);
    Domain domain(mesh, inputs, parameters.boundary);
    enter_setup_phase(kMeasureSurface);
    check_preservable(domain, parameters.preserve, parameters.flow);
    const double mean_edge = mean_edge_length(domain.surface());
    const double asked =
        asked_size(parameters, mesh, mean_edge, enclosing_grid(domain.surface(), 0)).in_mesh_units;
    const double limit = kLargestStepSizeInEdges * mean_edge * mean_edge;
    auto densities = triangle_densities(domain, parameters.local_detail_size, mean_edge);
    return {std::move(domain),
            std::move(densities),
            parameters,
            std::min(asked, limit),
            asked,
            parameters.preserve,
            parameters.iterations,
            parameters.depth,
            mean_edge,
            bytes};
}

Plan plan_of(Domain domain, ClippedSurface surface, double mean_edge,
             const FlowParameters& parameters) {
    auto densities = triangle_densities(domain, parameters.local_detail_size, mean_edge);
    const StepPlan steps = {
        parameters,
        asked_size(parameters, domain.mesh(), mean_edge, surface.grid),
        stabilization_of(parameters),
        parameters.solver == Solver::OneWCycle ? parameters.cycles : 0,
        parameters.quality == Quality::MeanCurvature,
        parameters.preserve != Preserve::None &&
            !scales_components(parameters.preserve, parameters.flow),
    };
    return {std::move(domain),
            std::move(surface),
            std::move(densities),
            discretisation_of(parameters),
            steps,
            parameters.preserve,
            parameters.iterations,
            mean_edge,
            0,
            0};
}

}  // namespace tracked_mcf
