// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/parallel/thread_team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "tests/unit/parallel/at_once.h"

namespace tracked_mcf {
namespace {

/// Gives the thread of all tests of this program a team, as evolve() does, so that the flows of
/// tests that do not call evolve() run in several threads, too.
class TeamOfTests : public ::testing::Environment {
    void SetUp() override { team_.emplace(0); }
    void TearDown() override { team_.reset(); }

    std::optional<ThreadTeam> team_;
};
const auto* const kTeamOfTests = ::testing::AddGlobalTestEnvironment(new TeamOfTests);

TEST(ThreadTeam, RunsEachItemOnceAndNoTwoOfAMemberAtOnce) {
    const ThreadTeam team(4);
    for (const std::int64_t count : {0, 1, 2, 3, 1000}) {
        std::vector<std::atomic<int>> runs(static_cast<std::size_t>(count));
        std::vector<std::atomic<bool>> busy(ThreadTeam::size());
        ThreadTeam::run(count, [&](std::int64_t item, std::size_t member) {
            ASSERT_LT(member, busy.size());
            EXPECT_FALSE(busy[member].exchange(true));
            ++runs[item];
            busy[member] = false;
        });
        for (const std::atomic<int>& n : runs) EXPECT_EQ(n, 1);
    }
}

TEST(ThreadTeam, RunsItemsAtTheSameTime) {
    const ThreadTeam team(3);
    for (int repetition = 0; repetition < 100; ++repetition) {
        // Each item waits until all have begun, so all members must take one.
        std::atomic<int> begun{0};
        ThreadTeam::run(3, [&](std::int64_t /*item*/, std::size_t /*member*/) {
            ++begun;
            while (begun < 3) std::this_thread::yield();
        });
    }
}

TEST(ThreadTeam, LetsItsOwnerRunAllItemsThatNobodyElseTakes) {
    const ThreadTeam team(3);
    // The first item of the other threads lasts until the owner has run all that are left.
    const std::thread::id owner = std::this_thread::get_id();
    std::atomic<int> held{0}, run{0};
    constexpr int count = 1000;
    ThreadTeam::run(count, [&](std::int64_t /*item*/, std::size_t member) {
        EXPECT_EQ(member == 0, std::this_thread::get_id() == owner);
        if (member != 0) {
            ++held;
            while (run + held < count) std::this_thread::yield();
        } else {
            ++run;
        }
    });
    EXPECT_EQ(run + held, count);
    EXPECT_LE(held, 2);
}

TEST(ThreadTeam, RunsLoopsInsideABodyInTheThreadOfTheBody) {
    const ThreadTeam team(3);
    std::atomic<int> runs{0};
    ThreadTeam::run(100, [&](std::int64_t /*item*/, std::size_t /*member*/) {
        EXPECT_EQ(ThreadTeam::size(), 1U);
        const std::thread::id outer = std::this_thread::get_id();
        ThreadTeam::run(10, [&](std::int64_t /*inner*/, std::size_t member) {
            EXPECT_EQ(member, 0U);
            EXPECT_EQ(std::this_thread::get_id(), outer);
            ++runs;
        });
    });
    EXPECT_EQ(runs, 1000);
    EXPECT_EQ(ThreadTeam::size(), 3U);
}

TEST(ThreadTeam, HidesTheOneBeforeItUntilItEnds) {
    const ThreadTeam outer(3);
    {
        const ThreadTeam inner(2);
        EXPECT_EQ(ThreadTeam::size(), 2U);
    }
    EXPECT_EQ(ThreadTeam::size(), 3U);
    std::thread([] { EXPECT_EQ(ThreadTeam::size(), 1U) << "a thread without a team"; }).join();
}

TEST(ThreadTeam, ServesSeveralOwnersAtOnce) {
    at_once(3, [](std::size_t thread) {
        const ThreadTeam team(3);
        for (int repetition = 0; repetition < 200; ++repetition) {
            std::atomic<std::int64_t> sum{0};
            ThreadTeam::run(50, [&](std::int64_t item, std::size_t /*member*/) { sum += item; });
            ASSERT_EQ(sum, 1225) << thread;
        }
    });
}

TEST(ThreadTeam, RethrowsOneExceptionAndGoesOn) {
    const ThreadTeam team(3);
    for (int repetition = 0; repetition < 100; ++repetition) {
        std::atomic<int> working{0};
        const auto fail = [&](std::int64_t item, std::size_t /*member*/) {
            ++working;
            if (item % 7 == 3) {
                --working;
                throw std::out_of_range("item");
            }
            --working;
        };
        EXPECT_THROW(ThreadTeam::run(100, fail), std::out_of_range);
        EXPECT_EQ(working, 0) << "an item still runs";
        EXPECT_EQ(ThreadTeam::size(), 3U);
    }
}

}  // namespace
}  // namespace tracked_mcf
