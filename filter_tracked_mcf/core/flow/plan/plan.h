// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "filter_tracked_mcf/core/flow/cells/fragments.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/mesh/surface.h"

namespace tracked_mcf {

/// What follows from a mesh, inputs and parameters before any element is made. A flow consumes it.
/// Its parts take members of the plan, and never read the parameters.
struct Plan {
    const TriangleMesh& mesh;  ///< must outlive the plan and the flow
    Surface surface;
    StepParameters steps;
    double step_size;        ///< δ, mesh units²
    double asked_step_size;  ///< larger if δ was limited: single precision loses masses beside it
    int iterations;
    double expected_bytes;  ///< of the whole flow
};

/// The plan of a flow on the mesh's own elements.
struct MeshPlan : Plan {
    Preserve preserve;
    int depth;  ///< of the octree, as asked for; 0 chooses it
};

/// The plan of the paper's flow.
struct PaperPlan : Plan {
    ClippedSurface clipped;
    Cubature cubature;
    int cycles;
};

/// Plans a flow on the mesh's own elements. The mesh, the inputs and the parameters must have
/// passed validate().
///
/// Throws InvalidMesh or InvalidParameter if the flow cannot preserve what it should, InvalidMesh
/// if the surface is none to compute with or all its vertices have strength 0, and NotEnoughMemory
/// if the flow is expected not to fit into the free memory.
MeshPlan mesh_plan_of(const TriangleMesh& mesh, const Inputs& inputs,
                      const FlowParameters& parameters);

/// Plans the paper's flow on a grid that encloses the mesh, at the depth that the parameters ask
/// for; otherwise like mesh_plan_of().
PaperPlan paper_plan_of(const TriangleMesh& mesh, const FlowParameters& parameters);

/// Plans the paper's flow on this grid.
PaperPlan paper_plan_of(const TriangleMesh& mesh, const FlowParameters& parameters,
                        const Grid& grid);

}  // namespace tracked_mcf
