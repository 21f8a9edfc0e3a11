// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "filter_tracked_mcf/core/filter_report.h"

namespace tracked_mcf {

/// Returns warnings for a user if a surface has cracks that are too wide to be closed, and if the
/// faces of a closed surface point inwards.
std::vector<std::string> surface_warnings(const FilterReport& report);

}  // namespace tracked_mcf
