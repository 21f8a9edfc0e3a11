// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/parallel/disjoint_sets.h"

#include <gtest/gtest.h>

namespace tracked_mcf {
namespace {

TEST(DisjointSets, TheSmallestMemberRepresentsASetForEveryOrderOfUnions) {
    for (const bool reversed : {false, true}) {
        DisjointSets sets(1000);
        for (std::int32_t i = 0; i < 998; ++i) {
            const std::int32_t member = reversed ? 997 - i : i;
            EXPECT_TRUE(sets.unite(member + 2, member));
        }
        for (std::int32_t i = 0; i < 1000; ++i) EXPECT_EQ(sets.find(i), i % 2);
        EXPECT_FALSE(sets.unite(2, 500));
        EXPECT_FALSE(sets.unite(7, 7));
    }
}

TEST(DisjointSets, ResetStartsAgain) {
    DisjointSets sets(3);
    sets.unite(0, 2);
    sets.reset(4);
    for (std::int32_t i = 0; i < 4; ++i) EXPECT_EQ(sets.find(i), i);
}

}  // namespace
}  // namespace tracked_mcf
