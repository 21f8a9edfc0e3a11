// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "filter_tracked_mcf/core/remove_noise.h"

namespace tracked_mcf {

/// Returns warnings for a user: surface_warnings(), if no noise was removed and why, and if parts
/// of the surface have lost more than noise.
std::vector<std::string> warnings_of(const NoiseParameters& parameters, const NoiseReport& report);

}  // namespace tracked_mcf
