// SPDX-License-Identifier: GPL-3.0-or-later

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "filter_tracked_mcf/core/parallel/disjoint_sets.h"
#include "tests/unit/parallel/at_once.h"

namespace tracked_mcf {
namespace {

using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

/// Unites the pairs in several threads and expects the sets of a serial loop.
void expect_the_sets_of_a_serial_loop(std::int32_t count, const Pairs& pairs) {
    DisjointSets expected(count);
    for (const auto& [a, b] : pairs) expected.unite(a, b);
    ConcurrentSets sets(count);
    at_once(4, [&](std::size_t thread) {
        for (std::size_t i = thread; i < pairs.size(); i += 4) {
            sets.unite(pairs[i].first, pairs[i].second);
        }
    });
    for (std::int32_t i = 0; i < count; ++i) ASSERT_EQ(sets.find(i), expected.find(i));
}

TEST(ConcurrentSets, AgreeWithDisjointSetsOnRandomPairs) {
    constexpr std::int32_t count = 20000;
    std::mt19937 random(2);
    std::uniform_int_distribution<std::int32_t> member(0, count - 1);
    Pairs pairs(count);
    for (auto& pair : pairs) pair = {member(random), member(random)};
    expect_the_sets_of_a_serial_loop(count, pairs);
}

TEST(ConcurrentSets, UniteAChainThatThreadsLinkFromItsEnd) {
    constexpr std::int32_t count = 20000;
    Pairs pairs;
    for (std::int32_t i = count - 1; i > 0; --i) pairs.emplace_back(i, i - 1);
    expect_the_sets_of_a_serial_loop(count, pairs);
}

TEST(ConcurrentSets, UniteFewMembersThatAllThreadsWantAtOnce) {
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

TEST(ConcurrentSets, FindStaysInTheSetWhileOthersUnite) {
    constexpr std::int32_t count = 4000;
    ConcurrentSets sets(count);
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
