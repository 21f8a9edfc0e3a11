// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "filter_tracked_mcf/core/fair.h"

namespace tracked_mcf {

/// Returns warnings for a user about patches whose surroundings are rough, and about those that
/// have less continuity than was asked for.
std::vector<std::string> warnings_of(const FairParameters& parameters, const FairReport& report);

}  // namespace tracked_mcf
