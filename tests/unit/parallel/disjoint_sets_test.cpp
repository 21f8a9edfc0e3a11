// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/parallel/disjoint_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "tests/unit/parallel/at_once.h"

namespace tracked_mcf {
namespace {

using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// Unites the pairs in several threads and expects the sets of a serial loop.
void expect_the_sets_of_a_serial_loop(std::int32_t count, const Pairs& pairs) {
    DisjointSets expected(count);
    for (const auto& [a, b] : pairs) expected.unite(a, b);
    DisjointSets sets(count);
    at_once(4, [&](std::size_t thread) {
        for (std::size_t i = thread; i < pairs.size(); i += 4) {
            sets.unite(pairs[i].first, pairs[i].second);
        }
    });
    for (std::int32_t i = 0; i < count; ++i) ASSERT_EQ(sets.find(i), expected.find(i));
}

TEST(DisjointSets, TheSmallestMemberRepresentsASetForEveryOrderOfUnions) {
    for (const bool reversed : {false, true}) {
        DisjointSets sets(1000);
        for (std::int32_t i = 0; i < 998; ++i) {
            const std::int32_t member = reversed ? 997 - i : i;
            sets.unite(member + 2, member);
        }
        for (std::int32_t i = 0; i < 1000; ++i) EXPECT_EQ(sets.find(i), i % 2);
    }
}

TEST(DisjointSets, OfThreadsAreThoseOfASerialLoop) {
    constexpr std::int32_t count = 20000;
    std::mt19937 random(2);
    std::uniform_int_distribution<std::int32_t> member(0, count - 1);
    Pairs pairs(count);
    for (auto& pair : pairs) pair = {member(random), member(random)};
    expect_the_sets_of_a_serial_loop(count, pairs);
}

TEST(DisjointSets, UniteAChainThatThreadsLinkFromItsEnd) {
    constexpr std::int32_t count = 20000;
    Pairs pairs;
    for (std::int32_t i = count - 1; i > 0; --i) pairs.emplace_back(i, i - 1);
    expect_the_sets_of_a_serial_loop(count, pairs);
}

TEST(DisjointSets, UniteFewMembersThatAllThreadsWantAtOnce) {
    std::mt19937 random(3);
    Pairs pairs;
    for (std::int32_t a = 0; a < 8; ++a) {
        for (std::int32_t b = 0; b < 8; ++b) pairs.emplace_back(a, b);
    }
    for (int round = 0; round < 50; ++round) {
        std::shuffle(pairs.begin(), pairs.end(), random);
        expect_the_sets_of_a_serial_loop(10, pairs);
    }
}

TEST(DisjointSets, FindStaysInTheSetWhileOthersUnite) {
    constexpr std::int32_t count = 4000;
    DisjointSets sets(count);
    at_once(3, [&](std::size_t thread) {
        for (std::int32_t i = count - 1; i >= 2; --i) {
            if (thread == 0) sets.unite(i, i - 2);
            const std::int32_t found = sets.find(i);
            EXPECT_LE(found, i);
            EXPECT_EQ(found % 2, i % 2);
        }
    });
}

}  // namespace
}  // namespace tracked_mcf
