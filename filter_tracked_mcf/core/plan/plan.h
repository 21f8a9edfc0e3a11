// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "filter_tracked_mcf/core/cells/fragments.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/mesh/domain.h"

namespace tracked_mcf {

/// A step size δ, a squared length.
struct StepSize {
    double in_cells;       ///< in squared sides of a finest cell
    double in_mesh_units;  ///< in squared units of the mesh
};

inline StepSize operator*(double factor, const StepSize& size) {
    return {factor * size.in_cells, factor * size.in_mesh_units};
}

/// Returns a step size that is given in squared sides of the grid's cells.
inline StepSize in_cells(double cells, const Grid& grid) {
    return {cells, cells * (grid.cell_size * grid.cell_size)};
}

/// How the steps of a flow are made.
struct StepPlan : StepParameters {
    StepSize size;  ///< δ as it was asked for
    double stabilization;
    int cycles;             ///< of the paper's solver; 0 for the one that converges
    bool takes_velocities;  ///< FlowState::velocity
    bool takes_responses;   ///< Stepper::pressure_response
};

/// All that follows from a mesh, inputs and parameters before any element is made. The Flow
/// consumes it. Its parts take members of the plan, and never read the parameters.
struct Plan {
    Domain domain;  ///< its mesh must outlive the plan
    ClippedSurface surface;
    std::vector<double> densities;  ///< per triangle of the surface (densities.h); empty if all 1
    Discretisation discretisation;
    StepPlan steps;
    Preserve preserve;
    int iterations;
    double mean_edge;       ///< of the surface, mesh units
    int resolving_depth;    ///< see FlowReport
    double expected_bytes;  ///< of the whole flow
};

/// All that follows from a mesh, inputs and parameters before a flow on the mesh's own elements is
/// set up.
struct MeshPlan {
    Domain domain;                  ///< its mesh must outlive the plan
    std::vector<double> densities;  ///< per triangle of the surface (densities.h); empty if all 1
    StepParameters steps;
    double step_size;        ///< δ, mesh units²
    double asked_step_size;  ///< larger if δ was limited, see FlowParameters::step_size
    Preserve preserve;
    int iterations;
    int depth;              ///< of the octree, as asked for; 0 chooses it
    double mean_edge;       ///< of the surface, mesh units
    double expected_bytes;  ///< of the whole flow
};

/// Plans a flow on the mesh's own elements; otherwise like plan_of().
MeshPlan mesh_plan_of(const TriangleMesh& mesh, const Inputs& inputs,
                      const FlowParameters& parameters);

/// Plans a flow on a grid that encloses the surface, at the depth that the parameters ask for. The
/// mesh, the inputs and the parameters must have passed validate().
///
/// Throws InvalidMesh or InvalidParameter if the flow cannot preserve what it should, InvalidMesh
/// if the surface is none to compute with or all its vertices have strength 0, and NotEnoughMemory
/// if the flow is expected not to fit into the free memory.
Plan plan_of(const TriangleMesh& mesh, const Inputs& inputs, FlowParameters parameters);

/// Plans a flow on the grid to which the domain's surface has been clipped. `mean_edge` is that of
/// the surface. Leaves resolving_depth and expected_bytes 0, and does not check what is preserved.
Plan plan_of(Domain domain, ClippedSurface surface, double mean_edge,
             const FlowParameters& parameters);

}  // namespace tracked_mcf
