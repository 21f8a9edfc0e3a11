// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "filter_tracked_mcf/core/flow_parameters.h"

namespace tracked_mcf::experiments {

/// Parses the flow, the solver and the functions of a run: words joined by commas. Each word
/// changes what the words before it have set.
///
///   converged      the defaults
///   paper          one W-cycle, no stabilisation, sheets not separated
///   kappa=X        weight of the stabilisation
///   tolerance=X    tolerance of the converged solver
///   cycles=N       W-cycles of the paper's solver
///   cubature=N     quadrature points of a split triangle: 1, 3 or 12
///   separate       separate sheets
///   glued          sheets in one cell share functions
///   free-pinches   pinched functions are not constrained
///   locked, locked-cells, free    the boundary, unless the experiment sets it
///
/// Throws std::invalid_argument for any other word.
FlowParameters parse_configuration(const std::string& words);

}  // namespace tracked_mcf::experiments
