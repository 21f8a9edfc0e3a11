// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <stdexcept>
#include <string>

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

/// A parameter is outside its range, or does not fit the mesh or another parameter.
struct InvalidParameter : Error {
    using Error::Error;
    /// what() is the name, a space and the problem. `refused` is the number that the parameter is.
    InvalidParameter(const std::string& parameter, const std::string& what_is_wrong,
                     double refused = std::numeric_limits<double>::quiet_NaN())
        : Error(parameter + ' ' + what_is_wrong),
          name(parameter),
          problem(what_is_wrong),
          number(refused) {}

    std::string name;     ///< Parameter::name; empty if no single parameter is wrong
    std::string problem;  ///< such as "is 13; give 0 to 12."
    double number = std::numeric_limits<double>::quiet_NaN();
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
