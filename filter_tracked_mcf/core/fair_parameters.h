// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/flow_parameters.h"

namespace tracked_mcf {

/// What a faired patch shares with the surface around it, along the seam.
enum class Continuity {
    Position,  ///< C0: the membrane
    Tangent,   ///< C1: the thin plate
    Curvature  ///< C2
};

/// The parameters of fair().
struct FairParameters {
    Continuity continuity = Continuity::Tangent;

    /// None or Displacement: what FairReport::quality holds.
    Quality quality = Quality::None;

    /// Number of threads; 0 takes ThreadTeam::default_size(). The result has the same bits for any
    /// number.
    int threads = 0;
};

/// Throws InvalidParameter if a value is outside its range.
void validate(const FairParameters& parameters);

}  // namespace tracked_mcf
