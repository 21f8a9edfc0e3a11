// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/parallel/sorting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"

namespace tracked_mcf {
namespace {

/// Expects sort_by_key() to sort the pairs as std::stable_sort does.
template <class Pairs>
void expect_stable_sort(Pairs& pairs) {
    std::vector<KeyValue> expected(pairs.begin(), pairs.end());
    std::stable_sort(expected.begin(), expected.end(),
                     [](const KeyValue& a, const KeyValue& b) { return a.key < b.key; });
    sort_by_key(pairs);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        ASSERT_EQ(pairs[i].key, expected[i].key);
        ASSERT_EQ(pairs[i].value, expected[i].value);
    }
}

TEST(SortByKey, AgreesWithTheLibrarysStableSort) {
    std::mt19937_64 random(3);
    for (const std::uint64_t largest : {0ULL, 5ULL, 70000ULL, ~0ULL}) {
        std::uniform_int_distribution<std::uint64_t> key(0, largest);
        std::vector<KeyValue> pairs(10000);
        for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i] = {key(random), i};
        expect_stable_sort(pairs);
    }
}

TEST(SortBy, IsStableOverManyBlocksAndSkipsBitsThatAllKeysHave) {
    const ThreadTeam threads(3);
    std::mt19937_64 random(5);
    constexpr std::uint64_t shared = std::uint64_t{0xabc} << 50U;
    RawVector<KeyValue> pairs(300000);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        pairs[i] = {shared | (random() % 5000) << 13U, i};
    }
    sort_by_key(pairs);
    for (std::size_t i = 1; i < pairs.size(); ++i) {
        const bool in_order =
            pairs[i - 1].key < pairs[i].key ||
            (pairs[i - 1].key == pairs[i].key && pairs[i - 1].value < pairs[i].value);
        ASSERT_TRUE(in_order) << i;
    }
}

/// The keys differ in their lowest and in their highest bits.
TEST(SortBy, SortsExtremeKeysAtTheEdgesOfChunks) {
    const std::vector<std::uint64_t> keys = {0, 1, 1023, 1024, ~0ULL, ~0ULL - 1, 1ULL << 63U, 1};
    for (const int threads : {1, 3}) {
        const ThreadTeam scope(threads);
        for (const std::int64_t count : {std::int64_t{0}, std::int64_t{1}, radix::kItems - 1,
                                         radix::kItems, radix::kItems + 1}) {
            RawVector<KeyValue> pairs(static_cast<std::size_t>(count));
            for (std::size_t i = 0; i < pairs.size(); ++i) {
                pairs[i] = {keys[(pairs.size() - i) % keys.size()], i};
            }
            expect_stable_sort(pairs);
        }
    }
}

TEST(RadixSort, DigitsCoverTheBitsInWhichKeysDiffer) {
    EXPECT_TRUE(radix::digits_of(0).empty());
    for (const std::uint64_t varying : {1ULL, 1ULL << 63U, 0x3ffULL, 0x7ff0ULL, ~0ULL}) {
        std::uint64_t covered = 0;
        unsigned next = 0;
        for (const radix::Digit& digit : radix::digits_of(varying)) {
            EXPECT_LE(digit.bits, radix::kMostBits);
            EXPECT_GE(digit.shift, next);
            next = digit.shift + digit.bits;
            covered |= static_cast<std::uint64_t>(digit.count() - 1) << digit.shift;
        }
        EXPECT_EQ(covered, varying) << "these bits are consecutive";
    }
}

TEST(Groups, InvertsAMap) {
    const Groups groups({2, 0, 2, 3, 0, 2}, 5);
    const auto members = [&](std::int32_t group) {
        const auto range = groups.members(group);
        return std::vector<std::int32_t>(range.begin(), range.end());
    };
    EXPECT_EQ(members(0), (std::vector<std::int32_t>{1, 4}));
    EXPECT_EQ(members(1), (std::vector<std::int32_t>{}));
    EXPECT_EQ(members(2), (std::vector<std::int32_t>{0, 2, 5}));
    EXPECT_EQ(members(3), (std::vector<std::int32_t>{3}));
    EXPECT_EQ(members(4), (std::vector<std::int32_t>{}));
}

}  // namespace
}  // namespace tracked_mcf
