// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/element_partition.h"

#include <gtest/gtest.h>

#include <numeric>
#include <vector>

#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

/// Returns a level of 32³ cells, an element each: eight subsets.
Level full_level() {
    std::vector<MortonCode> cells(32 * 32 * 32);
    std::iota(cells.begin(), cells.end(), MortonCode{0});
    return build_levels(cells, 5).back();
}

/// Adds value(element, i) to the unknown i of each element.
template <class Value>
void sum(const Level& level, const Field* base, Field& result, const Value& value) {
    ElementPartition(level).sum(base, result, [&](std::int32_t element, const auto& at) {
        for (int i = 0; i < 8; ++i) at(level.unknowns[element][i])[0] += value(element, i);
    });
}

/// A small whole number, so that sums of them are exact in any order.
float whole_number(std::int32_t element, int i) {
    return static_cast<float>((element + 3 * i) % 11);
}

TEST(ElementPartition, SumsWhatAllElementsAddToTheBase) {
    const Level level = full_level();
    Field expected = Field::Zero(4, level.unknown_count());
    for (std::int32_t element = 0; element < level.element_count(); ++element) {
        for (int i = 0; i < 8; ++i) {
            expected(0, level.unknowns[element][i]) += whole_number(element, i);
        }
    }
    const Field base = Field::Constant(4, level.unknown_count(), 7);
    Field result;
    for (int repetition = 0; repetition < 2; ++repetition) {
        sum(level, nullptr, result, whole_number);
        EXPECT_EQ(result, expected);
        sum(level, &base, result, whole_number);
        EXPECT_EQ(result, expected + base);
        sum(level, &result, result, whole_number);
        EXPECT_EQ(result, 2 * expected + base);
    }
}

TEST(ElementPartition, SumsToTheSameBitsWithAnyNumberOfThreads) {
    const Level level = full_level();
    std::vector<Field> results;
    for (const int count : {1, 2, 3, 8}) {
        const ThreadTeam threads(count);
        sum(level, nullptr, results.emplace_back(),
            [](std::int32_t element, int i) { return 1 / (1 + whole_number(element, i)); });
        EXPECT_EQ(results.back(), results.front());
    }
}

TEST(ElementPartition, AddsAMultipleOfTheAssembledProductToTheBase) {
    const LevelSystem system = vertex_system(two_shells(), 4, 0.5);
    const Field x = random_field(system.finest()), base = random_field(system.finest());
    const Field product = times(system, x);
    Field result;
    ElementPartition(system.finest()).add_products(system.matrices, -2, x, &base, result);
    EXPECT_LT((result - base + 2 * product).norm(), 1e-5 * product.norm());
}

}  // namespace
}  // namespace tracked_mcf
