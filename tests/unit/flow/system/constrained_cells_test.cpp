// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/system/constrained_cells.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/elements.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

TrackedElements elements_of_a_cap() {
    const TriangleMesh cap = bumpy_cap(20);
    return build_tracked_elements(cap, enclosing_grid(cap, 5), Cubature::ThreePoints);
}

TEST(ConstrainedCells, FunctionsThatAreZeroAtTheBoundaryStayFree) {
    const TrackedElements elements = elements_of_a_cap();
    const Level& finest = elements.finest();
    std::vector<std::uint8_t> expected(finest.unknown_count(), 0);
    for (std::int32_t element = 0; element < finest.element_count(); ++element) {
        if (elements.meets_held_side[element] == 0) continue;
        for (const std::int32_t unknown : finest.unknowns[element]) expected[unknown] = 1;
    }
    EXPECT_GT(std::count(expected.begin(), expected.end(), 0), 0);
    EXPECT_GT(std::count(expected.begin(), expected.end(), 1), 0);
    EXPECT_EQ(constrained_unknowns(elements).back(), expected);
}

TEST(ConstrainedCells, CoarseCorrectionsAreZeroAtConstrainedFineUnknowns) {
    // A child's value at a corner is a combination of its parent's eight values.
    const TrackedElements elements = elements_of_a_cap();
    const auto constrained = constrained_unknowns(elements);
    for (std::size_t level = 1; level < elements.levels.size(); ++level) {
        const Level& fine = elements.levels[level];
        std::vector<std::uint8_t> corrected = constrained[level];
        for (std::int32_t element = 0; element < fine.element_count(); ++element) {
            const auto& of_parent = elements.levels[level - 1].unknowns[fine.parents[element]];
            const bool parent_is_zero = std::all_of(
                of_parent.begin(), of_parent.end(),
                [&](std::int32_t unknown) { return constrained[level - 1][unknown] != 0; });
            if (!parent_is_zero) continue;
            for (const std::int32_t unknown : fine.unknowns[element]) corrected[unknown] = 0;
        }
        EXPECT_EQ(std::count(corrected.begin(), corrected.end(), 1), 0) << "level " << level;
    }
}

}  // namespace
}  // namespace tracked_mcf
