#pragma once

#include "filter_tracked_mcf/core/flow.h"

namespace tracked_mcf::experiments {

/// How far the surface has slipped from under the edges that hold it, mesh units.
struct Slip {
    double rms = 0;  ///< by length
    double worst = 0;
};

/// At the flow's held samples; zero if it has none.
Slip slip_at_held_edges(const Flow& flow);

}  // namespace tracked_mcf::experiments
