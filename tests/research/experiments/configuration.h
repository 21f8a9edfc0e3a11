// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <string>

#include "filter_tracked_mcf/core/flow/stepping/surface_flow.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf::experiments {

/// Parses the parameters of a run: words joined by commas. Each word changes what the words before
/// it have set. Steps have order 1, as in the paper, whatever the product's default is.
///
///   converged      the product's method: the mesh's own elements, solved to a tolerance
///   paper          the paper's method, with one W-cycle
///   tolerance=X    of the converged method
///   cycles=N       W-cycles of a solve, of the paper's method
///   cubature=N     quadrature points of a split triangle, of the paper's method: 1, 3 or 12
///   order=N        order of a step
///   locked, free   the boundary, unless the experiment sets it
///
/// Throws std::invalid_argument for any other word.
FlowParameters parse_configuration(const std::string& words);

/// Sets up the flow of a whole mesh by the method of the parameters.
std::unique_ptr<SurfaceFlow> make_flow(const TriangleMesh& mesh, const FlowParameters& parameters);

}  // namespace tracked_mcf::experiments
