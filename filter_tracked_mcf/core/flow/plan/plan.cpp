// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/plan/plan.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/flow/plan/densities.h"
#include "filter_tracked_mcf/core/flow/plan/paper_memory.h"
#include "filter_tracked_mcf/core/flow/plan/setup_phases.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/platform/process_memory.h"

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
            "A conformalized flow cannot preserve the volume because the surface is open: " +
            std::to_string(domain.boundary_edge_count()) +
            " edges have only one face. Close the holes first, or preserve the area.");
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

/// Beyond this δ, single precision loses the mass beside the stiffness, and with it the location of
/// a closed surface. In squared mean edge lengths, and in squared sides of the paper's cells.
constexpr double kLargestStepSizeInEdges = 5e4, kLargestStepSizeInCells = 1e5;

/// Bytes for each vertex and each triangle of a flow on the mesh's own elements, besides the mesh.
constexpr double kBytesPerVertex = 370, kBytesPerTriangle = 120;

/// The side of a cell of the paper's octree, in mean edge lengths, if its depth is automatic. A
/// surface has about 3 unknowns for each squared side of a cell, and 1.15 vertices for each squared
/// edge. So there are about as many unknowns as vertices.
constexpr double kAutomaticCellInEdges = 1.6;

/// Returns the plan of a flow, with a step size of at most `largest`.
Plan plan_of(Domain domain, const FlowParameters& parameters, double mean_edge, double largest,
             double bytes) {
    const double asked = parameters.step_size > 0
                             ? parameters.step_size
                             : step_size_for(detail_size_of(parameters, mean_edge),
                                             parameters.iterations, parameters.order);
    return {std::move(domain), parameters, std::min(asked, largest), asked, parameters.iterations,
            mean_edge,         bytes};
}

/// Returns the depth that the parameters ask for on the grid's cube.
int depth_of(const FlowParameters& parameters, double mean_edge, const Grid& cube) {
    if (parameters.depth > 0) return parameters.depth;
    const double cells = cube.cell_size / (kAutomaticCellInEdges * mean_edge);
    if (!(cells < std::exp2(kMaximumDepth))) return mean_edge > 0 ? kMaximumDepth : 1;
    return std::max(1, static_cast<int>(std::lround(std::log2(cells))));
}

}  // namespace

MeshPlan mesh_plan_of(const TriangleMesh& mesh, const Inputs& inputs,
                      const FlowParameters& parameters) {
    const double bytes = kBytesPerVertex * static_cast<double>(mesh.positions.size()) +
                         kBytesPerTriangle * static_cast<double>(mesh.triangles.size());
    check_free_memory(bytes, "The flow", "Simplify the mesh, or take a part of it.");
    enter_setup_phase(kFindEdges);
    Domain domain(mesh, inputs, parameters.boundary);
    enter_setup_phase(kMeasureSurface);
    check_preservable(domain, parameters.preserve, parameters.flow);
    const double mean_edge = mean_edge_length(domain.surface());
    auto densities = triangle_densities(domain);
    const double largest = kLargestStepSizeInEdges * mean_edge * mean_edge;
    return {plan_of(std::move(domain), parameters, mean_edge, largest, bytes), std::move(densities),
            parameters.preserve, parameters.depth};
}

PaperPlan paper_plan_of(const TriangleMesh& mesh, const FlowParameters& parameters) {
    const Grid cube = enclosing_grid(mesh, 0);
    return paper_plan_of(mesh, parameters,
                         with_depth(cube, depth_of(parameters, mean_edge_length(mesh), cube)));
}

PaperPlan paper_plan_of(const TriangleMesh& mesh, const FlowParameters& parameters,
                        const Grid& grid) {
    enter_setup_phase(kFindEdges);
    Domain domain(mesh, parameters.boundary);
    enter_setup_phase(kMeasureSurface);
    const double bytes = paper_flow_bytes(domain, grid, parameters.cubature, parameters.order);
    check_free_memory(bytes, "Depth " + std::to_string(grid.depth) + " of the paper's method",
                      "Choose a smaller depth, or the method Converged.");
    enter_setup_phase(kClipTriangles);
    ClippedSurface surface = clip_to_grid(domain.surface(), grid);
    const double largest = kLargestStepSizeInCells * grid.cell_size * grid.cell_size;
    return {plan_of(std::move(domain), parameters, mean_edge_length(mesh), largest, bytes),
            std::move(surface), parameters.cubature, parameters.cycles};
}

}  // namespace tracked_mcf
