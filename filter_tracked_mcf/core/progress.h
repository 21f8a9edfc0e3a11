// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string_view>

namespace tracked_mcf {

/// A callback that receives the fraction of the work that is done and the current phase, in words
/// for the user ("Step 3 of 10"). It returns false to cancel: the function that was given the
/// callback, such as evolve(), then throws Cancelled. An exception of the callback propagates to
/// the caller. In both cases the mesh keeps its positions.
///
/// - Times: the function invokes the callback whenever a phase begins, and about 20 times a second
///   in between. Serial work polls rarely, and can delay a call by up to 0.2 s for each million
///   vertices.
/// - Fraction: it lies in [0, 1] and never decreases. It is 1 in the last call, before the function
///   writes the positions.
/// - Thread: only the thread that called the function invokes the callback. Other threads may work
///   on the core's own data meanwhile.
/// - Nesting: the callback may call such a function for another mesh, which reports to its own
///   callback only. A callback is never invoked from inside itself.
using Progress = std::function<bool(double fraction, std::string_view phase)>;

}  // namespace tracked_mcf
