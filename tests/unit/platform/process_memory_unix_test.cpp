// SPDX-License-Identifier: GPL-3.0-or-later
/// Limits of memory that only Unix has.

#include "filter_tracked_mcf/core/platform/process_memory.h"

#include <gtest/gtest.h>

#include <string>

#include "filter_tracked_mcf/core/errors.h"
#include "tests/support/environment_variable.h"
#include "tests/unit/flows.h"
#include "tests/unit/platform/address_space_limit.h"
#include "tests/unit/system_files.h"

namespace tracked_mcf {
namespace {

TEST(NotEnoughMemory, LeavesTheMeshAsItWas) {
    if (TRACKED_MCF_SANITIZED) GTEST_SKIP() << "sanitizers need the whole address space";
    const TriangleMesh mesh = shapes::geodesic_sphere(20);
    TriangleMesh after = mesh;
    const AddressSpaceLimit limit(500'000'000);
    FlowParameters p = parameters(12, 1e-3, 1);
    p.method = Method::Paper;
    EXPECT_THROW(evolve(after, p), NotEnoughMemory);
    EXPECT_TRUE(same_bits(after, mesh));
}

TEST(NotEnoughMemory, IsSaidWithBothNumbersAndTheAdvice) {
    EXPECT_EQ(bytes_in_words(3.72e9), "3.7 GB");
    EXPECT_EQ(bytes_in_words(3.72e8), "372 MB");
    EXPECT_NO_THROW(check_free_memory(1, "The work", "Do less."));
    if (available_memory_bytes() == 0) GTEST_SKIP() << "this system does not tell";
    try {
        check_free_memory(1e18, "The work", "Do less.");
        FAIL() << "must throw";
    } catch (const NotEnoughMemory& error) {
        const std::string message = error.what();
        EXPECT_EQ(message.find("The work would need about 1000000000 GB of memory, but only "), 0U);
        EXPECT_NE(message.find(" are free. Do less. If more are free, set "), std::string::npos)
            << message;
    }
}

TEST(NotEnoughMemory, IsWhatTheEnvironmentSays) {
    const EnvironmentVariable variable("TRACKED_MCF_FREE_MEMORY");
    variable.set("1000");
    EXPECT_THROW(check_free_memory(2000, "The work", "Do less."), NotEnoughMemory);
    EXPECT_NO_THROW(check_free_memory(900, "The work", "Do less."));
    variable.set("1e30");
    EXPECT_NO_THROW(check_free_memory(1e20, "The work", "Do less."));
    for (const char* const wrong : {"much", "1 GB", "-1", "0", "nan"}) {
        variable.set(wrong);
        EXPECT_THROW(check_free_memory(1, "The work", "Do less."), InvalidParameter) << wrong;
    }
}

class AvailableMemoryByFiles : public SystemFiles {
protected:
    std::int64_t bytes() const { return available_memory_by_files(root_); }
};

TEST_F(AvailableMemoryByFiles, IsUnknownIfNoFileSaysIt) {
    EXPECT_EQ(bytes(), 0);
    write("/proc/meminfo", "MemTotal: many kB\nMemAvailable:\n");
    write("/proc/self/cgroup", "\n:\n::\n0::\n4:memory:/a\n");
    EXPECT_EQ(bytes(), 0);
}

TEST_F(AvailableMemoryByFiles, IncludesTheSwapSpace) {
    write("/proc/meminfo", "MemTotal: 8000 kB\nMemAvailable:    3000 kB\nSwapFree: 500 kB\n");
    EXPECT_EQ(bytes(), 1024 * 3500);
}

TEST_F(AvailableMemoryByFiles, IsAtMostWhatEveryControlGroupAllows) {
    write("/proc/meminfo", "MemAvailable: 3000 kB\n");
    write("/proc/self/cgroup", "0::/outer/inner\n");
    write("/sys/fs/cgroup/outer/inner/memory.max", "max\n");
    write("/sys/fs/cgroup/outer/inner/memory.current", "100000\n");
    EXPECT_EQ(bytes(), 1024 * 3000);
    write("/sys/fs/cgroup/outer/memory.max", "1000000\n");
    write("/sys/fs/cgroup/outer/memory.current", "300000\n");
    write("/sys/fs/cgroup/outer/memory.stat",
          "anon 5\ninactive_file 100000\nactive_file 20000\nslab_reclaimable 3000\n");
    EXPECT_EQ(bytes(), 823000) << "pages of files can be reclaimed";
    write("/sys/fs/cgroup/memory.max", "400000\n");
    write("/sys/fs/cgroup/memory.current", "300000\n");
    EXPECT_EQ(bytes(), 100000);
}

TEST_F(AvailableMemoryByFiles, KnowsTheFirstVersionOfControlGroups) {
    write("/proc/self/cgroup", "9:cpu,cpuacct:/x\n4:hugetlb,memory:/outer/inner\n");
    write("/sys/fs/cgroup/memory/outer/memory.limit_in_bytes", "1000000\n");
    write("/sys/fs/cgroup/memory/outer/memory.usage_in_bytes", "300000\n");
    EXPECT_EQ(bytes(), 700000);
    write("/sys/fs/cgroup/memory/outer/memory.stat",
          "active_file 1\ntotal_inactive_file 30000\ntotal_active_file 4000\n");
    EXPECT_EQ(bytes(), 734000);
    write("/sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
    write("/sys/fs/cgroup/memory/memory.usage_in_bytes", "900000\n");
    EXPECT_EQ(bytes(), 734000);
}

TEST_F(AvailableMemoryByFiles, IsThatOfTheMountIfAContainerHidesTheGroup) {
    write("/proc/self/cgroup", "5:devices:/x\n0::/not/seen/inside\n");
    write("/sys/fs/cgroup/memory.max", "1000000\n");
    write("/sys/fs/cgroup/memory.current", "300000\n");
    EXPECT_EQ(bytes(), 700000);
}

TEST_F(AvailableMemoryByFiles, IsPositiveEvenIfAllIsUsed) {
    write("/proc/self/cgroup", "0::/\n");
    write("/sys/fs/cgroup/memory.max", "1000\n");
    write("/sys/fs/cgroup/memory.current", "3000\n");
    EXPECT_EQ(bytes(), 1);
}

}  // namespace
}  // namespace tracked_mcf
