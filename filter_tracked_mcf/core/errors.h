// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

namespace tracked_mcf {

/// Base class of the core's own exceptions.
///
/// what() says in words for a user what is wrong and what to do. The caller's mesh is unchanged
/// whenever one is thrown. Besides these, std::bad_alloc and a callback's own exceptions may leave
/// the core.
struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The mesh cannot flow: it is empty, has coordinates that are not finite, or no area.
struct InvalidMesh : Error {
    using Error::Error;
};

/// A parameter is outside its range.
struct InvalidParameter : Error {
    using Error::Error;
};

/// The flow is expected to need more memory than is free.
struct NotEnoughMemory : Error {
    using Error::Error;
};

/// The progress callback asked to stop.
struct Cancelled : Error {
    using Error::Error;
};

}  // namespace tracked_mcf
