// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/plan/plan.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/flow/plan/paper_memory.h"
#include "filter_tracked_mcf/core/flow/plan/setup_phases.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/platform/process_memory.h"

namespace tracked_mcf {

namespace {

/// A surface is flat if its volume is below this fraction of its area to the power 3/2. The
/// fraction of a sphere is 0.09.
constexpr double kFlat = 1e-9;

void check_nothing_held(const Surface& surface, const char* what) {
    if (!surface.has_held_vertices()) return;
    throw InvalidParameter(
        std::string(what) +
        " would move vertices that must stay: those of a boundary that is not free, those of "
        "unselected faces, and those with strength 0. Preserve the volume of a mean-curvature flow "
        "instead, or free all vertices.");
}

void check_oriented(const Surface& surface) {
    if (surface.is_oriented_alike()) return;
    throw InvalidMesh(
        "The volume cannot be preserved because the faces cannot be oriented alike: the surface "
        "has only one side, or more than two faces share an edge. Preserve the area instead.");
}

void check_encloses_volume(const Surface& surface) {
    if (surface.counts.boundary_edges > 0) {
        throw InvalidMesh(
            "A conformalized flow cannot preserve the volume because the surface is open: " +
            std::to_string(surface.counts.boundary_edges) +
            " edges have only one face. Close the holes first, or preserve the area.");
    }
    double volume = 0, area = 0;
    for (const Triangle& t : surface.stars.triangles) {
        const auto [a, b, c] = corners_of(surface.positions, t);
        const Eigen::Vector3d normal = twice_vector_area(a, b, c);
        volume += a.dot(normal) / 6;
        area += normal.norm() / 2;
    }
    if (!surface.bounds_volume() || std::abs(volume) <= kFlat * std::pow(area, 1.5)) {
        throw InvalidMesh(
            "The volume cannot be preserved because the surface encloses none; preserve the area "
            "instead.");
    }
}

/// Returns whether parts are scaled to preserve this, instead of pushed along their normals.
bool scales_parts(Preserve preserve, FlowKind flow) {
    return preserve == Preserve::Area || flow == FlowKind::Conformalized;
}

/// Throws InvalidParameter or InvalidMesh if the flow cannot preserve this; see
/// FlowParameters::preserve.
void check_preservable(const Surface& surface, Preserve preserve, FlowKind flow) {
    if (preserve == Preserve::None) return;
    if (preserve == Preserve::Area) {
        check_nothing_held(surface, "Preserving the area");
        return;
    }
    check_oriented(surface);
    if (!scales_parts(preserve, flow)) return;
    check_nothing_held(surface, "Preserving the volume of a conformalized flow");
    check_encloses_volume(surface);
}

/// Beyond this δ, single precision loses the mass beside the stiffness, and with it the location of
/// a closed surface. In squared mean edge lengths, and in squared sides of the paper's cells.
constexpr double kLargestStepSizeInEdges = 5e4, kLargestStepSizeInCells = 1e5;

/// Bytes besides the mesh to make a surface of it, and those of a flow on the elements of the
/// surface besides these: for each vertex and each triangle.
constexpr double kBytesPerMeshVertex = 120, kBytesPerMeshTriangle = 30, kBytesPerVertex = 250,
                 kBytesPerTriangle = 90;

/// The side of a cell of the paper's octree, in mean edge lengths, if its depth is automatic. A
/// surface has about 3 unknowns for each squared side of a cell, and 1.15 vertices for each squared
/// edge. So there are about as many unknowns as vertices.
constexpr double kAutomaticCellInEdges = 1.6;

/// Returns the plan of a flow, with a step size of at most `largest`.
Plan plan_of(const TriangleMesh& mesh, Surface surface, const FlowParameters& parameters,
             double largest, double bytes) {
    const double asked = parameters.step_size > 0
                             ? parameters.step_size
                             : step_size_for(detail_size_of(parameters, surface.edge),
                                             parameters.iterations, parameters.order);
    return {mesh,  std::move(surface),    parameters, std::min(asked, largest),
            asked, parameters.iterations, bytes};
}

/// Returns the depth that the parameters ask for on the grid's cube.
int depth_of(const FlowParameters& parameters, double mean_edge, const Grid& cube) {
    if (parameters.depth > 0) return parameters.depth;
    const double cells = cube.cell_size / (kAutomaticCellInEdges * mean_edge);
    if (!(cells < std::exp2(kMaximumDepth))) return mean_edge > 0 ? kMaximumDepth : 1;
    return std::max(1, static_cast<int>(std::lround(std::log2(cells))));
}

/// Returns the bytes that a flow on the mesh's own elements takes. The surface has the share of the
/// vertices that it has of the triangles.
double mesh_flow_bytes(const TriangleMesh& mesh, const Selection& selection) {
    const auto vertices = static_cast<double>(mesh.positions.size());
    const auto triangles = static_cast<double>(mesh.triangles.size());
    const auto unselected = static_cast<double>(
        std::count(selection.begin(), selection.end(), Selection::value_type{0}));
    const double share = triangles > 0 ? 1 - unselected / triangles : 0;
    return kBytesPerMeshVertex * vertices + kBytesPerMeshTriangle * triangles +
           share * (kBytesPerVertex * vertices + kBytesPerTriangle * triangles);
}

}  // namespace

MeshPlan mesh_plan_of(const TriangleMesh& mesh, const Inputs& inputs,
                      const FlowParameters& parameters) {
    const double bytes = mesh_flow_bytes(mesh, inputs.selection);
    check_free_memory(bytes, "The flow", "Simplify the mesh, or take a part of it.");
    enter_setup_phase(kFindEdges);
    Surface surface = surface_of(mesh, inputs, parameters.boundary);
    enter_setup_phase(kMeasureSurface);
    check_preservable(surface, parameters.preserve, parameters.flow);
    const double largest = kLargestStepSizeInEdges * surface.edge * surface.edge;
    return {plan_of(mesh, std::move(surface), parameters, largest, bytes), parameters.preserve,
            parameters.depth};
}

namespace {

/// Returns the surface on which the paper's flow is planned.
Surface paper_surface_of(const TriangleMesh& mesh, const FlowParameters& parameters) {
    enter_setup_phase(kFindEdges);
    return surface_of(mesh, {}, parameters.boundary);
}

PaperPlan paper_plan_on(const Grid& grid, const TriangleMesh& mesh, Surface surface,
                        const FlowParameters& parameters) {
    enter_setup_phase(kMeasureSurface);
    const Positions positions = surface.in_mesh_units(mesh);
    const double bytes =
        paper_flow_bytes(surface, positions, grid, parameters.cubature, parameters.order);
    check_free_memory(bytes, "Depth " + std::to_string(grid.depth) + " of the paper's method",
                      "Choose a smaller depth, or the method Converged.");
    enter_setup_phase(kClipTriangles);
    ClippedSurface clipped = clip_to_grid({positions, surface.stars.triangles}, grid);
    const double largest = kLargestStepSizeInCells * grid.cell_size * grid.cell_size;
    return {plan_of(mesh, std::move(surface), parameters, largest, bytes), std::move(clipped),
            parameters.cubature, parameters.cycles};
}

}  // namespace

PaperPlan paper_plan_of(const TriangleMesh& mesh, const FlowParameters& parameters) {
    Surface surface = paper_surface_of(mesh, parameters);
    const Grid cube = enclosing_grid(surface.box, 0);
    const int depth = depth_of(parameters, surface.edge, cube);
    return paper_plan_on(with_depth(cube, depth), mesh, std::move(surface), parameters);
}

PaperPlan paper_plan_of(const TriangleMesh& mesh, const FlowParameters& parameters,
                        const Grid& grid) {
    return paper_plan_on(grid, mesh, paper_surface_of(mesh, parameters), parameters);
}

}  // namespace tracked_mcf
