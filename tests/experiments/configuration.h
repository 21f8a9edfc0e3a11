#pragma once

#include <string>

#include "filter_tracked_mcf/core/flow_parameters.h"

namespace tracked_mcf::experiments {

/// Which flow, solver and functions a run uses, as the command line spells it: words joined by
/// commas, each of which changes what the words before it have set.
///
///   converged      the defaults
///   paper          one W-cycle, no stabilisation, sheets not separated
///   kappa=X        weight of the stabilisation
///   tolerance=X    of the converged solver
///   cycles=N       of the paper's solver
///   separate       sheets separated
///   glued          sheets not separated
///   unanchored     what has pinched is not held
///   conformalized  the conformalized flow
///   locked, locked-cells, free    the boundary; where an experiment does not choose it
///   spring=X       stiffness of what holds a locked boundary
///   spring-alone   what the spring holds is not taken up
///   keep-area      rescaled after every step; where an experiment says so
///
/// Throws std::invalid_argument for anything else.
FlowParameters parse_configuration(const std::string& words);

}  // namespace tracked_mcf::experiments
