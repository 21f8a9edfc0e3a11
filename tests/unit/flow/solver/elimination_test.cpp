// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/elimination.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

/// Squares of cells in rows, one after the other, of so many vertices a side.
struct Squares {
    explicit Squares(const std::vector<std::int32_t>& sides)
        : stars(stars_of(sides)), blocks(parts), elimination(stars, blocks) {}

    Stars stars_of(const std::vector<std::int32_t>& sides) {
        RawVector<Triangle> triangles;
        std::int32_t first = 0;
        for (std::size_t part = 0; part < sides.size(); ++part) {
            const std::int32_t side = sides[part];
            for (std::int32_t y = 1; y < side; ++y) {
                for (std::int32_t x = 1; x < side; ++x) {
                    const std::int32_t d = first + y * side + x, c = d - 1, b = d - side, a = b - 1;
                    triangles.push_back({a, b, d});
                    triangles.push_back({a, d, c});
                }
            }
            first += side * side;
            parts.resize(static_cast<std::size_t>(first), static_cast<std::int32_t>(part));
        }
        return {std::move(triangles), first};
    }
    /// Returns the rows of a stage that are one thread's.
    std::vector<std::vector<std::int32_t>> rows_of_stage(std::size_t stage) const {
        std::vector<std::vector<std::int32_t>> rows;
        const auto append = [&](const Elimination::Rows& some) {
            rows.emplace_back(some.begin(), some.end());
        };
        if (stage == 0) {
            for (std::int32_t i = 0; i < blocks.count(); ++i) append(elimination.inside(i));
        } else {
            for (const auto& separator : elimination.later_stages()[stage - 1])
                append(separator.rows);
        }
        return rows;
    }
    std::size_t stage_count() const { return elimination.later_stages().size() + 1; }

    std::vector<std::int32_t> parts;
    Stars stars;
    PartBlocks blocks;
    Elimination elimination;
};

TEST(Elimination, HasEachRowOnceInAnOrderThatThreadsCanShare) {
    const Squares squares({20, 300, 3, 40});
    std::vector<std::size_t> stages(squares.parts.size()), groups(stages.size());
    std::vector<int> visits(stages.size(), 0);
    std::size_t group = 0;
    for (std::size_t stage = 0; stage < squares.stage_count(); ++stage) {
        for (const auto& rows : squares.rows_of_stage(stage)) {
            EXPECT_TRUE(std::is_sorted(rows.begin(), rows.end()));
            for (const std::int32_t row : rows) {
                stages[row] = stage;
                groups[row] = group;
                ++visits[row];
            }
            ++group;
        }
    }
    EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), squares.stars.count());
    for (std::int32_t row = 0; row < squares.stars.count(); ++row) {
        for_each_neighbour(squares.stars, row, [&](std::int32_t other) {
            if (stages[row] == stages[other]) {
                EXPECT_EQ(groups[row], groups[other]);
            }
            const bool is_before =
                stages[row] == stages[other] ? row < other : stages[row] < stages[other];
            EXPECT_EQ(squares.elimination.precedes(row, other), is_before);
        });
    }
}

TEST(Elimination, LeavesASmallShareToEachLaterStage) {
    const Squares squares({300});  // 88 blocks of 1024 rows
    ASSERT_EQ(squares.stage_count(), 3);
    const auto separators = squares.rows_of_stage(1), last = squares.rows_of_stage(2);
    EXPECT_EQ(separators.size(), 3) << "of 32 blocks each";
    ASSERT_EQ(last.size(), 1);
    std::size_t rows = 0;
    for (const auto& some : separators) rows += some.size();
    // Blocks are strips of three lines: a line or so of each has neighbours before.
    EXPECT_NEAR(static_cast<double>(rows), 85 * 301, 85);
    EXPECT_NEAR(static_cast<double>(last[0].size()), 2 * 301, 2);
    for (const auto& separator : squares.elimination.later_stages()[0])
        EXPECT_EQ(separator.part, 0);
}

TEST(Elimination, OfAPartIsThatOfThePartAlone) {
    const Squares alone({70}), both({50, 70});
    constexpr std::int32_t first = 50 * 50;
    ASSERT_EQ(both.stage_count(), alone.stage_count());
    for (std::size_t stage = 0; stage < alone.stage_count(); ++stage) {
        std::vector<std::int32_t> rows;
        for (const auto& some : both.rows_of_stage(stage)) {
            for (const std::int32_t row : some) {
                if (row >= first) rows.push_back(row - first);
            }
        }
        std::vector<std::int32_t> expected;
        for (const auto& some : alone.rows_of_stage(stage))
            expected.insert(expected.end(), some.begin(), some.end());
        EXPECT_EQ(rows, expected);
    }
}

TEST(Elimination, OfNoRowsIsEmpty) {
    const Squares none({});
    EXPECT_EQ(none.stage_count(), 1);
    EXPECT_TRUE(none.rows_of_stage(0).empty());
}

}  // namespace
}  // namespace tracked_mcf
