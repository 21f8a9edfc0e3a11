// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/parallel/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <random>
#include <stdexcept>
#include <vector>

namespace tracked_mcf {
namespace {

constexpr std::int64_t kSizes[] = {0, 1, kChunkSize - 1, kChunkSize, 5 * kChunkSize + 7};

TEST(ParallelForRuns, VisitsEveryRunOnceAndDividesNone) {
    const ThreadTeam threads(3);
    std::mt19937 random(1);
    for (const std::int64_t count : kSizes) {
        // Some runs are longer than a chunk.
        std::vector<int> run_of;
        while (static_cast<std::int64_t>(run_of.size()) < count) {
            const std::size_t length = random() % 4 == 0 ? 3000 : 1 + random() % 5;
            run_of.insert(run_of.end(), length, static_cast<int>(run_of.size()));
        }
        const auto begins = [&](std::int64_t i) { return i == 0 || run_of[i] != run_of[i - 1]; };
        std::vector<int> visits(run_of.size(), 0);
        parallel_for_runs(count, begins, [&](std::int64_t begin, std::int64_t end) {
            for_each_run(begin, end, begins, [&](std::int64_t first, std::int64_t last) {
                EXPECT_TRUE(begins(first));
                EXPECT_TRUE(last == count || begins(last));
                EXPECT_EQ(run_of[first], run_of[last - 1]);
                for (std::int64_t i = first; i < last; ++i) ++visits[i];
            });
        });
        for (std::int64_t i = 0; i < count; ++i) ASSERT_EQ(visits[i], 1);
    }
}

TEST(ParallelForRuns, LetsBodiesChangeTheirItemsInPlace) {
    const ThreadTeam threads(3);
    struct Item {
        std::int64_t run, number;
    };
    std::vector<Item> items;
    items.reserve(20 * kChunkSize);
    for (std::int64_t i = 0; i < 20 * kChunkSize; ++i) items.push_back({i / 7, i});
    const auto count = static_cast<std::int64_t>(items.size());
    const auto begins = [&](std::int64_t i) { return i == 0 || items[i].run != items[i - 1].run; };
    parallel_for_runs(count, begins, [&](std::int64_t begin, std::int64_t end) {
        for_each_run(begin, end, begins, [&](std::int64_t first, std::int64_t last) {
            std::reverse(items.begin() + first, items.begin() + last);
        });
    });
    for (std::int64_t i = 0; i < count; ++i) {
        ASSERT_EQ(items[i].run, i / 7);
        ASSERT_EQ(items[i].number, std::min(count, 7 * (i / 7) + 7) - 1 - i % 7);
    }
}

TEST(Parallel, PrefixSumsAndCountsAreThoseOfASerialLoop) {
    const ThreadTeam threads(3);
    for (const std::int64_t count : kSizes) {
        const auto size = [](std::int64_t i) { return i % 7; };
        std::vector<std::int64_t> offsets;
        parallel_prefix_sum(count, size, offsets);
        ASSERT_EQ(offsets.size(), static_cast<std::size_t>(count) + 1);
        EXPECT_EQ(offsets[0], 0);
        for (std::int64_t i = 0; i < count; ++i) ASSERT_EQ(offsets[i + 1], offsets[i] + size(i));

        const auto counted = [](std::int64_t i) { return i % 3 == 0; };
        EXPECT_EQ(parallel_count(count, counted), (count + 2) / 3);
        const std::int64_t all = parallel_scan<std::int64_t>(
            count, counted, [&](std::int64_t first, std::int64_t, std::int64_t sum) {
                EXPECT_EQ(sum, (first + 2) / 3);
            });
        EXPECT_EQ(all, (count + 2) / 3);
    }
}

TEST(ParallelFor, SkipsTheRemainingBodiesAfterAnException) {
    for (const int threads : {1, 3}) {
        const ThreadTeam scope(threads);
        std::atomic<int> done{0};
        EXPECT_THROW(parallel_for(1000000,
                                  [&](std::int64_t i) {
                                      if (i == 10) throw std::length_error("enough");
                                      ++done;
                                  }),
                     std::length_error);
        EXPECT_LT(done, 1000000 - 1);
        if (threads == 1) {
            EXPECT_EQ(done, 10);
        }
    }
}

TEST(ParallelForBlocksWith, GivesEveryThreadItsOwnWorkspace) {
    const ThreadTeam scope(3);
    constexpr std::int64_t count = 20 * kChunkSize + 1;
    std::atomic<int> made{0};
    std::vector<int> visits(count, 0);
    parallel_for_chunks_with(
        count,
        [&] {
            ++made;
            return std::vector<std::int64_t>(1, -1);
        },
        [&](std::vector<std::int64_t>& workspace, std::int64_t begin, std::int64_t end) {
            for (std::int64_t i = begin; i < end; ++i) {
                workspace[0] = i;
                ++visits[i];
                EXPECT_EQ(workspace[0], i);
            }
        });
    EXPECT_LE(made, 3);
    EXPECT_GE(made, 1);
    EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](int n) { return n == 1; }));
}

}  // namespace
}  // namespace tracked_mcf
