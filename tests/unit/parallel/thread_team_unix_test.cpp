// SPDX-License-Identifier: GPL-3.0-or-later
/// Teams in processes that fork, as Python's multiprocessing does on Linux, or that have little
/// left.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <set>
#include <thread>

#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/platform/processors.h"
#include "tests/support/environment_variable.h"
#include "tests/unit/platform/address_space_limit.h"
#include "tests/unit/system_files.h"

namespace tracked_mcf {
namespace {

std::int64_t sum_of_squares(int threads = 2) {
    const ThreadTeam team(threads);
    return parallel_sum(100 * kChunkSize, std::int64_t{0},
                        [](std::int64_t begin, std::int64_t end) {
                            std::int64_t sum = 0;
                            for (std::int64_t i = begin; i < end; ++i) sum += i * i;
                            return sum;
                        });
}

/// Expects a forked process to compute the sum.
void expect_sum_of_child() {
    const std::int64_t expected = sum_of_squares();
    const pid_t child = fork();
    if (child == 0) {
        alarm(10);  // Its signal ends a child that hangs.
        std::_Exit(sum_of_squares() == expected ? 0 : 1);
    }
    int status = -1;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), 0);
    EXPECT_EQ(sum_of_squares(), expected);
}

TEST(ForkedProcess, RunsLoops) {
    expect_sum_of_child();
}

TEST(ForkedProcess, RunsLoopsIfAnotherThreadWasInALoop) {
    std::atomic<int> begun{0};
    std::atomic<bool> forked{false};
    std::thread other([&] {
        const ThreadTeam team(3);
        parallel_for(3, [&](std::int64_t /*i*/) {
            ++begun;
            while (!forked) std::this_thread::yield();
        });
    });
    // Until all threads have started: in the child, nobody would release a sanitizer's lock that a
    // starting thread holds.
    while (begun < 3) std::this_thread::yield();
    expect_sum_of_child();
    forked = true;
    other.join();
}

TEST(ForkedProcess, UsesThreadsOfItsOwn) {
    sum_of_squares();
    const pid_t child = fork();
    if (child == 0) {
        alarm(10);
        // Each item waits until the other one has begun.
        const ThreadTeam team(2);
        std::atomic<int> begun{0};
        parallel_for(2, [&](std::int64_t /*i*/) {
            ++begun;
            while (begun < 2) std::this_thread::yield();
        });
        std::_Exit(0);
    }
    int status = -1;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
}

TEST(ThreadTeam, SleepsWhileItHasNothingToDo) {
    const ThreadTeam team(4);
    const std::clock_t begin = std::clock();
    // One thread has an item that lasts, the others have none; then all have none.
    parallel_for(4, [](std::int64_t i) {
        if (i == 0) std::this_thread::sleep_for(std::chrono::milliseconds(300));
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    const double processor_seconds = double(std::clock() - begin) / CLOCKS_PER_SEC;
    // A busy machine starts threads slowly, above all with sanitizers.
    EXPECT_LT(processor_seconds, 0.25) << "threads that spin take 0.3 s or more";
}

TEST(ThreadTeam, StaysSmallerIfTheSystemRefusesThreads) {
    if (TRACKED_MCF_SANITIZED) GTEST_SKIP() << "sanitizers need the whole address space";
    const std::int64_t expected = sum_of_squares();
    // Less than a stack. The C library has kept a few stacks of earlier threads.
    const AddressSpaceLimit limit(1'000'000);
    EXPECT_EQ(sum_of_squares(64), expected);
}

TEST(ThreadTeam, TakesItsSizeFromOmpNumThreadsElseFromTheProcessors) {
    const EnvironmentVariable variable("OMP_NUM_THREADS");
    for (const auto& [value, size] : {std::pair{"3", 3},
                                      {"5,2", 5},
                                      {"", processor_count()},
                                      {"0", processor_count()},
                                      {"many", processor_count()}}) {
        variable.set(value);
        EXPECT_EQ(ThreadTeam::default_size(), size) << value;
        const ThreadTeam team(0);
        EXPECT_EQ(ThreadTeam::size(), static_cast<std::size_t>(size)) << value;
    }
}

class ProcessorQuota : public SystemFiles {
protected:
    void SetUp() override {
        SystemFiles::SetUp();
        write("/proc/self/cgroup", "4:cpu:/a\n0::/outer/inner\n");
    }
};

TEST_F(ProcessorQuota, IsTheLeastOfTheControlGroupsRoundedUp) {
    write("/sys/fs/cgroup/outer/inner/cpu.max", "350000 100000\n");
    EXPECT_EQ(processor_quota(root_), 4);
    write("/sys/fs/cgroup/outer/cpu.max", "150000 100000\n");
    EXPECT_EQ(processor_quota(root_), 2);
    write("/sys/fs/cgroup/cpu.max", "10000 100000\n");
    EXPECT_EQ(processor_quota(root_), 1);
}

TEST_F(ProcessorQuota, KnowsTheFirstVersionOfControlGroups) {
    write("/proc/self/cgroup", "4:cpu,cpuacct:/a\n3:memory:/b\n");
    write("/sys/fs/cgroup/cpu/a/cpu.cfs_quota_us", "150000\n");
    write("/sys/fs/cgroup/cpu/a/cpu.cfs_period_us", "100000\n");
    EXPECT_EQ(processor_quota(root_), 2);
    write("/sys/fs/cgroup/cpu/a/cpu.cfs_quota_us", "-1\n");
    EXPECT_GT(processor_quota(root_), 1'000'000);
}

TEST_F(ProcessorQuota, IsLargerThanAnyMachineIfThereIsNone) {
    for (const char* text : {"max 100000\n", "", "100000\n", "1 0\n", "-1 100000\n", "1e300 1\n"}) {
        write("/sys/fs/cgroup/outer/inner/cpu.max", text);
        EXPECT_GT(processor_quota(root_), 1'000'000) << text;
    }
}

#ifdef __linux__
TEST(ProcessorCount, FollowsTheAffinityMask) {
    cpu_set_t before, one;
    ASSERT_EQ(sched_getaffinity(0, sizeof before, &before), 0);
    EXPECT_LE(processor_count(), CPU_COUNT(&before));
    CPU_ZERO(&one);
    CPU_SET(sched_getcpu(), &one);
    ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
    EXPECT_EQ(processor_count(), 1);
    ASSERT_EQ(sched_setaffinity(0, sizeof before, &before), 0);
}
#endif

}  // namespace
}  // namespace tracked_mcf
