// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/parallel/marks.h"

#include <gtest/gtest.h>

#include "tests/unit/parallel/at_once.h"

namespace tracked_mcf {
namespace {

TEST(Marks, AreSetInAParallelLoop) {
    const ThreadTeam threads(3);
    constexpr std::int64_t count = 20 * kChunkSize + 3;
    Marks marks(count);
    EXPECT_EQ(marks.count(), 0);
    parallel_for_rows(count, [&](std::int32_t i) { marks.set(i / 2); });
    EXPECT_EQ(marks.count(), (count + 1) / 2);
    const std::vector<std::uint8_t> flags = marks.flags();
    for (std::int64_t i = 0; i < count; ++i) ASSERT_EQ(flags[i], i <= count / 2 ? 1 : 0);
}

TEST(Marks, OfNeighboursAndOfOneItemAreSetByAllThreadsAtOnce) {
    constexpr std::int64_t count = 4000;
    Marks marks(count);
    at_once(4, [&](std::size_t thread) {
        // Each thread has every fourth flag to itself and shares flag 0 with the others.
        for (auto i = static_cast<std::int64_t>(thread); i < count; i += 4) {
            marks.set(i);
            marks.set(0);
            EXPECT_TRUE(marks[i]);
        }
    });
    EXPECT_EQ(marks.count(), count);
}

}  // namespace
}  // namespace tracked_mcf
