#include "filter_tracked_mcf/core/sorting.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "filter_tracked_mcf/core/morton.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/raw_vector.h"

namespace tracked_mcf {
namespace {

TEST(SortByKey, AgreesWithTheLibrarysStableSort) {
    std::mt19937_64 random(3);
    for (const std::uint64_t largest : {0ULL, 5ULL, 70000ULL, ~0ULL}) {
        std::uniform_int_distribution<std::uint64_t> key(0, largest);
        std::vector<KeyValue> pairs(10000);
        for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i] = {key(random), i};
        std::vector<KeyValue> expected = pairs;
        std::stable_sort(expected.begin(), expected.end(),
                         [](const KeyValue& a, const KeyValue& b) { return a.key < b.key; });
        sort_by_key(pairs);
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            ASSERT_EQ(pairs[i].key, expected[i].key);
            ASSERT_EQ(pairs[i].value, expected[i].value);
        }
    }
}

TEST(SortBy, IsStableOverManyBlocksAndSkipsBitsThatAllKeysShare) {
    const ThreadCountScope threads(3);
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

TEST(Morton, IsInvertibleAndNested) {
    std::mt19937 random(4);
    std::uniform_int_distribution<std::int32_t> coordinate(0, (1 << 12) - 1);
    for (int i = 0; i < 1000; ++i) {
        const Cell cell(coordinate(random), coordinate(random), coordinate(random));
        const MortonCode code = morton_code(cell);
        EXPECT_EQ(cell_at(code), cell);
        EXPECT_EQ(cell_at(parent_of(code)), Cell(cell[0] / 2, cell[1] / 2, cell[2] / 2));
        EXPECT_EQ(octant_of(code), (cell[0] & 1) + 2 * (cell[1] & 1) + 4 * (cell[2] & 1));
    }
}

}  // namespace
}  // namespace tracked_mcf
