// What large loops are made of: the same results whatever the number of threads.
#include "filter_tracked_mcf/core/parallel.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <set>

#include "filter_tracked_mcf/core/concurrent_sets.h"
#include "filter_tracked_mcf/core/disjoint_sets.h"
#include "filter_tracked_mcf/core/marks.h"
#include "filter_tracked_mcf/core/raw_vector.h"

namespace tracked_mcf {
namespace {

constexpr std::int64_t kSizes[] = {0, 1, kBlockSize - 1, kBlockSize, 5 * kBlockSize + 7};

TEST(Parallel, RunsStayTogetherAndAllAreVisitedOnce) {
    const ThreadCountScope threads(3);
    std::mt19937 random(1);
    for (const std::int64_t count : kSizes) {
        // Some runs are longer than blocks.
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

TEST(Parallel, AddsUpAndNumbersAsOneLoopWould) {
    const ThreadCountScope threads(3);
    for (const std::int64_t count : kSizes) {
        const auto size = [](std::int64_t i) { return i % 7; };
        std::vector<std::int64_t> begin;
        parallel_add_up(count, size, begin);
        ASSERT_EQ(begin.size(), static_cast<std::size_t>(count) + 1);
        EXPECT_EQ(begin[0], 0);
        for (std::int64_t i = 0; i < count; ++i) ASSERT_EQ(begin[i + 1], begin[i] + size(i));

        const auto counted = [](std::int64_t i) { return i % 3 == 0; };
        EXPECT_EQ(parallel_count(count, counted), (count + 2) / 3);
        const std::int64_t all =
            number_blocks(count, counted, [&](std::int64_t first, std::int64_t, std::int64_t n) {
                EXPECT_EQ(n, (first + 2) / 3);
            });
        EXPECT_EQ(all, (count + 2) / 3);
    }
}

TEST(ConcurrentSets, AreTheDisjointSets) {
    const ThreadCountScope threads(3);
    constexpr std::int32_t count = 20 * kBlockSize;
    std::mt19937 random(2);
    std::uniform_int_distribution<std::int32_t> member(0, count - 1);
    std::vector<std::pair<std::int32_t, std::int32_t>> pairs(count);
    for (auto& pair : pairs) pair = {member(random), member(random)};

    DisjointSets expected(count);
    for (const auto& [a, b] : pairs) expected.unite(a, b);
    ConcurrentSets sets(count);
    parallel_for_items(pairs, [&](const auto& pair) { sets.unite(pair.first, pair.second); });
    for (std::int32_t i = 0; i < count; ++i) ASSERT_EQ(sets.find(i), expected.find(i));
}

TEST(Marks, AreSetByAnyThread) {
    const ThreadCountScope threads(3);
    constexpr std::int64_t count = 20 * kBlockSize + 3;
    Marks marks(count);
    EXPECT_EQ(marks.count(), 0);
    parallel_for_rows(count, [&](std::int32_t i) { marks.set(i / 2); });
    EXPECT_EQ(marks.count(), (count + 1) / 2);
    const std::vector<std::uint8_t> flags = marks.flags();
    for (std::int64_t i = 0; i < count; ++i) ASSERT_EQ(flags[i], i <= count / 2 ? 1 : 0);
}

TEST(RawVector, HoldsWhatIsWrittenWhateverItsSize) {
    for (const std::size_t size : {std::size_t{3}, std::size_t{1} << 20U}) {
        RawVector<std::uint64_t> numbers(size);
        std::iota(numbers.begin(), numbers.end(), 0U);
        RawVector<std::uint64_t> copy = numbers;
        numbers.resize(2 * size, 7);
        EXPECT_TRUE(std::equal(copy.begin(), copy.end(), numbers.begin()));
        EXPECT_EQ(numbers.back(), 7U);
    }
}

}  // namespace
}  // namespace tracked_mcf
