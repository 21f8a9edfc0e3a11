// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over elements in parallel: ElementPartition and ElementBricks.

#include "filter_tracked_mcf/core/flow/solver/element_partition.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "filter_tracked_mcf/core/flow/solver/element_bricks.h"

namespace tracked_mcf {
namespace {

constexpr int kThreadCounts[] = {1, 2, 3, 8};

/// Returns a level of 32³ cells, an element each: eight parts.
Level full_level() {
    std::vector<MortonCode> cells(32 * 32 * 32);
    std::iota(cells.begin(), cells.end(), MortonCode{0});
    return build_levels(cells, 5).back();
}

/// Adds value(element, i) to the unknown i of each element.
template <class Value>
void sum(const ElementPartition& partition, const Field* base, Field& result, const Value& value) {
    partition.sum(base, result, [&](const ElementRange& range, float* sums) {
        for (std::int32_t element = range.begin; element < range.end; ++element) {
            const auto targets = targets_of(range, element, sums);
            for (int i = 0; i < 8; ++i) *targets[i] += value(element, i);
        }
    });
}

/// A small whole number, so that sums of them are exact in any order.
float whole_number(std::int32_t element, int i) {
    return static_cast<float>((element + 3 * i) % 11);
}

float fraction(std::int32_t element, int i) {
    return 1 / (1 + whole_number(element, i));
}

TEST(ElementPartition, SumsWhatAllElementsAddToTheBase) {
    const Level level = full_level();
    const ElementPartition partition(level);
    Field expected = Field::Zero(4, level.unknown_count());
    for (std::int32_t element = 0; element < level.element_count(); ++element) {
        for (int i = 0; i < 8; ++i) {
            expected(0, level.unknowns[element][i]) += whole_number(element, i);
        }
    }
    const Field base = Field::Constant(4, level.unknown_count(), 7);
    Field result;
    for (int repetition = 0; repetition < 2; ++repetition) {
        sum(partition, nullptr, result, whole_number);
        EXPECT_EQ(result, expected);
        sum(partition, &base, result, whole_number);
        EXPECT_EQ(result, expected + base);
        sum(partition, &result, result, whole_number);
        EXPECT_EQ(result, 2 * expected + base);
    }
}

TEST(ElementPartition, SumsToTheSameBitsWithAnyNumberOfThreads) {
    const Level level = full_level();
    const ElementPartition partition(level);
    std::vector<Field> results;
    for (const int count : kThreadCounts) {
        const ThreadTeam threads(count);
        sum(partition, nullptr, results.emplace_back(), fraction);
        EXPECT_EQ(results.back(), results.front());
    }
}

TEST(ElementBricks, VisitEachElementOnceAndAddInTheSameOrderWithAnyNumberOfThreads) {
    const Level level = full_level();
    const ElementBricks bricks(level);
    std::vector<std::vector<float>> results;
    for (const int count : kThreadCounts) {
        const ThreadTeam threads(count);
        std::vector<int> visits(level.unknowns.size());
        results.emplace_back(level.unknown_count());
        bricks.for_each([&](std::int32_t begin, std::int32_t end) {
            for (std::int32_t element = begin; element < end; ++element) {
                ++visits[element];
                for (int i = 0; i < 8; ++i) {
                    results.back()[level.unknowns[element][i]] += fraction(element, i);
                }
            }
        });
        EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), level.element_count());
        EXPECT_EQ(results.back(), results.front());
    }
}

}  // namespace
}  // namespace tracked_mcf
