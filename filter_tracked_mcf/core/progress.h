#pragma once

#include <functional>
#include <string_view>

namespace tracked_mcf {

/// Called as the work goes on, with the fraction done and what is being done, for a person
/// ("Step 3 of 10"). Returning false asks the work to stop: it throws Cancelled; what the callback
/// throws itself passes through as it is. Either way the mesh is as it was.
///
/// - How often: whenever something else begins to be done, and in between about every twentieth of
///   a second, however large the mesh.
/// - The fraction is in [0, 1], never decreases, and is 1 in the last call, before the mesh is
///   written.
/// - From the thread that called the core only, though other threads may be at work on the core's
///   own data meanwhile.
/// - It may call the core, for other meshes, which reports to the callback it is given there, if
///   any: never is this one called from inside itself.
using Progress = std::function<bool(double fraction, std::string_view phase)>;

}  // namespace tracked_mcf
