// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/tool/output_file.h"

#include <gtest/gtest.h>

#include "filter_tracked_mcf/tool/file_error.h"
#include "tests/tool/temporary_folder.h"

namespace tracked_mcf {
namespace {

namespace fs = std::filesystem;

std::size_t file_count(const TemporaryFolder& folder) {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
}

TEST(OutputFile, AppearsWithAllStagedFilesWhenCommitted) {
    const TemporaryFolder folder;
    OutputFile output(folder / "a.obj");
    write_file(output.stage(), "mesh");
    write_file(output.stage().parent_path() / "a.obj.mtl", "materials");
    EXPECT_FALSE(fs::exists(folder / "a.obj"));
    output.commit();
    EXPECT_EQ(read_file(folder / "a.obj"), "mesh");
    EXPECT_EQ(read_file(folder / "a.obj.mtl"), "materials");
}

TEST(OutputFile, KeepsTheOldFileUnlessCommitted) {
    const TemporaryFolder folder;
    write_file(folder / "a.ply", "before");
    {
        OutputFile output(folder / "a.ply");
        output.stage_text("half");
    }
    EXPECT_EQ(read_file(folder / "a.ply"), "before");
    EXPECT_EQ(file_count(folder), 1u) << "nothing temporary stays";
}

TEST(OutputFile, CheckingLeavesNothingBehind) {
    const TemporaryFolder folder;
    OutputFile output(folder / "a.ply");
    EXPECT_EQ(file_count(folder), 0u);
}

TEST(OutputFile, ReplacesTheFileThatALinkLeadsTo) {
    const TemporaryFolder folder;
    write_file(folder / "real.ply", "before");
    fs::create_symlink(folder / "real.ply", folder / "link.ply");
    OutputFile output(folder / "link.ply");
    output.stage_text("after");
    output.commit();
    EXPECT_TRUE(fs::is_symlink(folder / "link.ply"));
    EXPECT_EQ(read_file(folder / "real.ply"), "after");
}

TEST(OutputFile, RefusesPathsThatCannotBeWrittenAtOnce) {
    const TemporaryFolder folder;
    EXPECT_THROW(OutputFile(folder / "missing/a.ply"), UnwritableFile);
    EXPECT_THROW(OutputFile(folder.path()), UnwritableFile);
    EXPECT_THROW(OutputFile("/dev/full"), UnwritableFile);
    EXPECT_THROW(OutputFile("/proc/a.ply"), UnwritableFile);
}

}  // namespace
}  // namespace tracked_mcf
