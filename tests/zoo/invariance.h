// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "tests/zoo/case_run.h"
#include "tests/zoo/properties.h"

namespace tracked_mcf::zoo {

/// Checks that the unit, the order and the place in space of a case do not matter. `base` is its
/// run, which must have been made.
std::vector<Failure> check_invariance(const Case& checked, const Run& base, Random& random);

}  // namespace tracked_mcf::zoo
