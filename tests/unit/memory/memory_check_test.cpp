// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/memory/memory_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/memory/process_memory.h"
#include "filter_tracked_mcf/core/octree/automatic_depth.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;

class CheckOfASphere : public ::testing::Test {
protected:
    MemoryCheck with(std::int64_t available) const {
        return {size_, enclosing_grid(mesh_, 0), parameters_, available};
    }

    /// Returns the message that refuses a flow at this depth, or "" if it fits.
    std::string refusal(int depth, std::int64_t available) const {
        try {
            with(available).before_flow(depth);
        } catch (const NotEnoughMemory& error) {
            return error.what();
        }
        return {};
    }

    const TriangleMesh mesh_ = shapes::geodesic_sphere(20);
    const FlowParameters parameters_{};
    const SurfaceSize size_ = size_of(Domain(mesh_, parameters_.boundary));
};

TEST_F(CheckOfASphere, AllowsWhatFitsAndEverythingIfTheMemoryIsUnknown) {
    const auto needed = static_cast<std::int64_t>(std::ceil(with(0).flow_bytes(8)));
    EXPECT_EQ(refusal(8, needed), "");
    EXPECT_EQ(refusal(8, 0), "");
    EXPECT_NE(refusal(8, needed - 1), "");
}

TEST_F(CheckOfASphere, NamesTheLargestDepthThatFits) {
    const auto enough_for_9 = static_cast<std::int64_t>(1.01 * with(0).flow_bytes(9));
    EXPECT_THAT(refusal(12, enough_for_9),
                MatchesRegex("Depth 12 would need about [0-9]+ GB of memory, but only [0-9.]+ GB "
                             "are free. Choose depth 9 or less, which needs about [0-9.]+ GB, or "
                             "smooth a simplified mesh or a part of it."));
    EXPECT_EQ(refusal(9, enough_for_9), "");
}

TEST_F(CheckOfASphere, SaysThatNoDepthFits) {
    EXPECT_THAT(refusal(10, 1000),
                HasSubstr("No depth would fit: smooth a simplified mesh, or a part of it."));
    EXPECT_THAT(refusal(1, 1000), HasSubstr("No depth would fit"));
}

TEST_F(CheckOfASphere, ClippingNeedsLess) {
    const MemoryCheck check = with(static_cast<std::int64_t>(with(0).flow_bytes(9) / 2));
    EXPECT_NO_THROW(check.before_clipping(9));
    EXPECT_THROW(check.before_clipping(12), NotEnoughMemory);
}

/// Limits the address space of this process to `bytes` more than it has, for the scope's life.
class AddressSpaceLimit {
public:
    explicit AddressSpaceLimit(std::int64_t bytes) {
        getrlimit(RLIMIT_AS, &before_);
        std::ifstream statm("/proc/self/statm");
        std::int64_t pages = 0;
        statm >> pages;
        rlimit limit = before_;
        limit.rlim_cur = static_cast<rlim_t>(pages * sysconf(_SC_PAGESIZE) + bytes);
        setrlimit(RLIMIT_AS, &limit);
    }
    ~AddressSpaceLimit() { setrlimit(RLIMIT_AS, &before_); }
    AddressSpaceLimit(const AddressSpaceLimit&) = delete;
    AddressSpaceLimit& operator=(const AddressSpaceLimit&) = delete;

private:
    rlimit before_{};
};

TEST(NotEnoughMemory, LeavesTheMeshAsItWas) {
    if (TRACKED_MCF_SANITIZED) GTEST_SKIP() << "sanitizers need the whole address space";
    const TriangleMesh mesh = shapes::geodesic_sphere(20);
    TriangleMesh after = mesh;
    const AddressSpaceLimit limit(500'000'000);
    EXPECT_THROW(evolve(after, parameters(12, 1e-3, 1)), NotEnoughMemory);
    EXPECT_TRUE(same_bits(after, mesh));
}

TEST(NotEnoughMemory, IsThrownBeforeTheAutomaticDepthClips) {
    const TriangleMesh mesh = shapes::geodesic_sphere(20);
    const Grid cube = enclosing_grid(mesh, 0);
    std::vector<int> depths;
    const auto note = [&](int depth) { depths.push_back(depth); };
    const auto not_separated = [](int) { return 0.0; };
    const int chosen = clip_at_automatic_depth(mesh, cube, 4002, not_separated, note).grid.depth;
    EXPECT_THAT(depths, ::testing::Contains(chosen));
    const auto refuse = [](int) { throw NotEnoughMemory(""); };
    EXPECT_THROW(clip_at_automatic_depth(mesh, cube, 4002, not_separated, refuse), NotEnoughMemory);
}

/// Writes files that stand for those of a system.
class AvailableMemory : public ::testing::Test {
protected:
    void SetUp() override { std::filesystem::remove_all(root_); }
    void TearDown() override { std::filesystem::remove_all(root_); }

    void write(const std::string& path, const std::string& content) const {
        const std::filesystem::path file = root_ + path;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file) << content;
    }

    std::int64_t bytes() const { return available_memory_by_files(root_); }

    const std::string root_ =
        ::testing::TempDir() + "tracked_mcf_available_memory_" + std::to_string(getpid());
};

TEST_F(AvailableMemory, OfThisMachineIsPositiveOrUnknown) {
    EXPECT_GE(available_memory_bytes(), 0);
}

TEST_F(AvailableMemory, IsUnknownIfNoFileSaysIt) {
    EXPECT_EQ(bytes(), 0);
    write("/proc/meminfo", "MemTotal: many kB\nMemAvailable:\n");
    write("/proc/self/cgroup", "\n:\n::\n0::\n4:memory:/a\n");
    EXPECT_EQ(bytes(), 0);
}

TEST_F(AvailableMemory, IncludesTheSwapSpace) {
    write("/proc/meminfo", "MemTotal: 8000 kB\nMemAvailable:    3000 kB\nSwapFree: 500 kB\n");
    EXPECT_EQ(bytes(), 1024 * 3500);
}

TEST_F(AvailableMemory, IsAtMostWhatEveryControlGroupAllows) {
    write("/proc/meminfo", "MemAvailable: 3000 kB\n");
    write("/proc/self/cgroup", "0::/outer/inner\n");
    write("/sys/fs/cgroup/outer/inner/memory.max", "max\n");
    write("/sys/fs/cgroup/outer/inner/memory.current", "100000\n");
    EXPECT_EQ(bytes(), 1024 * 3000);
    write("/sys/fs/cgroup/outer/memory.max", "1000000\n");
    write("/sys/fs/cgroup/outer/memory.current", "300000\n");
    write("/sys/fs/cgroup/outer/memory.stat", "anon 5\ninactive_file 100000\n");
    EXPECT_EQ(bytes(), 800000) << "inactive files can be reclaimed";
    write("/sys/fs/cgroup/memory.max", "400000\n");
    write("/sys/fs/cgroup/memory.current", "300000\n");
    EXPECT_EQ(bytes(), 100000);
}

TEST_F(AvailableMemory, KnowsVersion1OfControlGroupsAndContainers) {
    write("/proc/self/cgroup", "5:devices:/x\n4:cpu,memory:/not/seen/inside\n0::/\n");
    write("/sys/fs/cgroup/memory/memory.limit_in_bytes", "1000000\n");
    write("/sys/fs/cgroup/memory/memory.usage_in_bytes", "300000\n");
    write("/sys/fs/cgroup/memory/memory.stat", "inactive_file 7\ntotal_inactive_file 100000\n");
    EXPECT_EQ(bytes(), 800000);
}

TEST_F(AvailableMemory, IsPositiveEvenIfAllIsUsed) {
    write("/proc/self/cgroup", "0::/\n");
    write("/sys/fs/cgroup/memory.max", "1000\n");
    write("/sys/fs/cgroup/memory.current", "3000\n");
    EXPECT_EQ(bytes(), 1);
}

}  // namespace
}  // namespace tracked_mcf
