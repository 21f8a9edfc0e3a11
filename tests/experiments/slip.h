// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/flow/flow.h"

namespace tracked_mcf::experiments {

/// The distance of the surface from its constrained edges, in mesh units.
struct Slip {
    double rms = 0;  ///< weighted by length
    double worst = 0;
};

/// Measures the slip at the flow's curve samples. Returns zero if there are none.
Slip slip_at_constrained_edges(const Flow& flow);

}  // namespace tracked_mcf::experiments
