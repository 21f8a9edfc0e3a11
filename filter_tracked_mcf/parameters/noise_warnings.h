// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "filter_tracked_mcf/core/remove_noise.h"

namespace tracked_mcf {

/// Returns a warning for a user if nothing has moved, because all is constrained or has no noise,
/// or if the surface is inside_out(). `advice` is for solvers that stop short, which this filter
/// has not.
std::vector<std::string> warnings_of(const NoiseParameters& parameters, const NoiseReport& report,
                                     const std::string& advice);

}  // namespace tracked_mcf
