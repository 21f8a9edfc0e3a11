// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/parameter_table.h"

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parameters/parameter_rows.h"
#include "filter_tracked_mcf/core/plain_text.h"

namespace tracked_mcf {

namespace {

using namespace parameter_rows;
using Type = Parameter::Type;
using P = FlowParameters;

std::string shortest(double value) {
    return plain(value, 10);  // enough for every int
}

/// Returns the numbers of a range, such as "1 to 4".
std::string text_of(const Range& range) {
    const std::string smallest = shortest(range.smallest), largest = shortest(range.largest);
    if (range.open) return "a number greater than " + smallest + " and less than " + largest;
    return smallest + (range.largest < kFinite ? " to " + largest : " or more");
}

}  // namespace

void check_range(const std::string& name, double value, const Range& range) {
    const bool fits = range.open ? value > range.smallest && value < range.largest
                                 : value >= range.smallest && value <= range.largest;
    if (fits) return;  // a NaN does not
    throw InvalidParameter(
        name, "is " + shortest(value) + "; give " + text_of(range) + range.advice + ".", value);
}

template <>
const std::vector<ParameterOf<P>>& parameter_table() {
    static const std::vector<ParameterOf<P>> table = {
        named(access<&P::detail_size>(
                  Type::Length,
                  {0, kFinite, ", in units of the mesh, where 0 takes 3 mean edge lengths"}),
              "detail_size", "Detail size (0: auto)",
              "Bumps of this size become half as high, smaller ones nearly vanish. 0 takes 3 mean "
              "edge lengths."),
        named(integer<&P::iterations>(1, kMaximumIterations), "iterations", "Smoothing steps",
              "Steps in which the detail is removed, 1 to 1000000. More are more accurate."),
        named(integer<&P::order, P>(1, kMaximumOrder), "order", "Order (1 to 4)",
              "1 is the flow itself, 4 keeps larger shapes best. Each order more takes another "
              "solve."),
        named(choice<&P::preserve>({{"None", "none"}, {"Area", "area"}, {"Volume", "volume"}}),
              "preserve", "Preserve",
              "Each connected part keeps its area or volume. Area needs a surface of which no "
              "vertex is held."),
        named(choice<&P::boundary, P>({{"Locked", "locked"}, {"Free", "free"}}), "boundary",
              "Boundary", "Locked holds the rim's vertices. Free moves them."),
        named(choice<&P::quality>({{"Unchanged", "none"},
                                   {"Displacement", "displacement"},
                                   {"Mean curvature", "mean-curvature"}}),
              "quality", "Vertex quality",
              "For colours: how far the vertex moved along its normal, or the mean curvature after "
              "smoothing."),
        named(access<&P::step_size>(Type::Real,
                                    {0, kFinite,
                                     ", in squared units of the mesh, where 0 takes that of the "
                                     "detail size"}),
              "step_size", "Step size (expert)",
              "Time step in squared units of the mesh. 0 takes that of the detail size."),
        named(integer<&P::depth>(0, kMaximumDepth, ", where 0 chooses automatically"), "depth",
              "Octree depth (expert)",
              "1 to 12: 2^depth cells a side, which only speed the default method up. 0 is "
              "automatic."),
        named(choice<&P::flow, P>(
                  {{"Mean curvature", "mean-curvature"}, {"Conformalized", "conformalized"}}),
              "flow", "Flow (expert)",
              "Mean curvature pinches thin parts. Conformalized makes closed surfaces spheres."),
        named(
            choice<&P::method>({{"Converged", "converged"}, {"Paper", "paper"}}), "method",
            "Method (expert)",
            "Paper is only to compare: it leaves detail finer than its cells, and locks all cells "
            "at the rim."),
        named(
            access<&P::tolerance, P>(Type::Real, {0, 1, ", such as 1e-3", true}), "tolerance", "",
            "With method converged: a solve ends when its error estimate, relative to its "
            "solution in the energy norm, is at most this number; greater than 0, less than 1. A "
            "step has as many solves as its order. A smaller number takes more iterations. With "
            "the default, no wave keeps more or less of its height by 0.2 %, but where a step "
            "hardly moves a smooth surface, its displacement may be off by 2 % at order 2, and by "
            "17 % at order 3."),
        threads<&P::threads>(),
    };
    return table;
}

template <>
const std::vector<Input>& input_table<P>() {
    static const std::vector<Input> table = {
        selected("Vertices of other faces stay. Select a little more than needed, because the seam "
                 "cannot move."),
        strength("A number from 0 to 1 at each vertex multiplies the detail size. 0 holds the "
                 "vertex.")};
    return table;
}

}  // namespace tracked_mcf
