// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow_report.h"
#include "tests/zoo/zoo_case.h"

namespace tracked_mcf::zoo {

/// What must hold for every flow. properties.cpp gives the bounds and their reasons.
enum class Property {
    Error,        ///< an exception is one of errors.h, and the mesh then keeps its bits
    Finite,       ///< all results are finite
    Box,          ///< no vertex leaves the initial bounding box by more than its filter may
    Area,         ///< the area never exceeds the initial one if nothing is preserved
    Loss,         ///< the removal of noise takes no area or volume without a warning
    Report,       ///< the numbers of the report are those of the meshes, in any order and unit
    Unmoved,      ///< vertices that do not flow keep their bits
    Time,         ///< the processor time is in proportion to the size
    Threads,      ///< the bits are those of 2, 3 and 8 threads, and of a second run
    Scale,        ///< the bits are those of the mesh in a unit that is a power of two
    Order,        ///< the order of vertices and triangles does not matter
    Translation,  ///< neither does the place in space
};

inline constexpr std::array<const char*, 12> kPropertyNames = {
    "error",   "finite", "box",     "area",  "loss",  "report",
    "unmoved", "time",   "threads", "scale", "order", "translation"};

struct Failure {
    Property property;
    std::string what;  ///< how far the result is from what it should be
};

struct Outcome {
    std::string refusal;  ///< message of the exception of errors.h; empty if the flow was made
    std::vector<Failure> failures;
};

/// Runs a case and checks the properties. Those that need more runs are checked too if
/// `all_properties`; `random` chooses the orders and translations.
Outcome check(const Case& checked, bool all_properties, Random& random);

}  // namespace tracked_mcf::zoo
