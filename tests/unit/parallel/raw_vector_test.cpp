// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/parallel/raw_vector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>

namespace tracked_mcf {
namespace {

TEST(RawVector, KeepsItsItemsWhenItGrows) {
    for (const std::size_t size : {std::size_t{3}, std::size_t{1} << 20U}) {
        RawVector<std::uint64_t> numbers(size);
        std::iota(numbers.begin(), numbers.end(), 0U);
        RawVector<std::uint64_t> copy = numbers;
        numbers.resize(2 * size, 7);
        EXPECT_TRUE(std::equal(copy.begin(), copy.end(), numbers.begin()));
        EXPECT_EQ(numbers.back(), 7U);
    }
}

TEST(RawVector, RunsConstructorsAndDefaultMemberInitializers) {
    struct Item {
        std::int32_t number = -1;
        std::string text = "initial";
    };
    RawVector<Item> items(1);
    items[0] = {5, std::string(100, 'x')};
    items.resize(1000);
    EXPECT_EQ(items[0].number, 5);
    EXPECT_EQ(items[0].text.size(), 100U);
    EXPECT_TRUE(std::all_of(items.begin() + 1, items.end(), [](const Item& item) {
        return item.number == -1 && item.text == "initial";
    }));
}

}  // namespace
}  // namespace tracked_mcf
