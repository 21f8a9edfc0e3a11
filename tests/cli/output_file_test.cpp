// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/output_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "filter_tracked_mcf/hosts/cli/file_error.h"
#include "tests/cli/temporary_folder.h"

namespace tracked_mcf {
namespace {

namespace fs = std::filesystem;

std::size_t file_count(const TemporaryFolder& folder) {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
}

TEST(OutputFile, AppearsWhenCommitted) {
    const TemporaryFolder folder;
    OutputFile output(folder / "a.obj");
    write_text(output, "mesh");
    EXPECT_FALSE(fs::exists(folder / "a.obj"));
    output.commit();
    EXPECT_EQ(read_file(folder / "a.obj"), "mesh");
}

TEST(OutputFile, KeepsTheOldFileUnlessCommitted) {
    const TemporaryFolder folder;
    write_file(folder / "a.ply", "before");
    {
        OutputFile output(folder / "a.ply");
        write_text(output, "half");
    }
    EXPECT_EQ(read_file(folder / "a.ply"), "before");
    EXPECT_EQ(file_count(folder), 1u) << "nothing temporary stays";
}

TEST(OutputFile, CheckingLeavesNothingBehind) {
    const TemporaryFolder folder;
    OutputFile output(folder / "a.ply");
    EXPECT_EQ(file_count(folder), 0u);
}

TEST(OutputFile, ANewVersionIsANewFile) {
    const TemporaryFolder folder;
    write_file(folder / "a.ply", "before");
    fs::create_hard_link(folder / "a.ply", folder / "b.ply");
    commit(folder / "a.ply", "after");
    EXPECT_EQ(read_file(folder / "a.ply"), "after");
    EXPECT_EQ(read_file(folder / "b.ply"), "before");
    EXPECT_EQ(file_count(folder), 2u) << "nothing temporary stays";
}

TEST(OutputFile, RefusesReadOnlyFiles) {
    const TemporaryFolder folder;
    write_file(folder / "a.ply", "before");
    fs::permissions(folder / "a.ply", fs::perms::owner_read);
    if (std::ofstream(folder / "a.ply", std::ios::app)) GTEST_SKIP() << "root may write it";
    EXPECT_THROW(OutputFile(folder / "a.ply"), UnwritableFile);
    EXPECT_EQ(read_file(folder / "a.ply"), "before");
    fs::permissions(folder / "a.ply", fs::perms::owner_all);  // or else Windows cannot remove it
}

TEST(OutputFile, RefusesPathsThatCannotBeWrittenAtOnce) {
    const TemporaryFolder folder;
    EXPECT_THROW(OutputFile(folder / "missing/a.ply"), UnwritableFile);
    EXPECT_THROW(OutputFile(folder.path()), UnwritableFile);
}

}  // namespace
}  // namespace tracked_mcf
