#pragma once

#include <functional>
#include <string_view>

namespace tracked_mcf {

/// Called from the calling thread as the work goes on, with the fraction done, in [0, 1] and never
/// decreasing, and what is being done, for a person ("Step 3 of 10"). Returning false asks the work
/// to stop: it throws Cancelled.
using Progress = std::function<bool(double fraction, std::string_view phase)>;

}  // namespace tracked_mcf
