// SPDX-License-Identifier: GPL-3.0-or-later
/// What only Windows refuses: to replace a file that another program has open.

#include <gtest/gtest.h>

#include <fstream>

#include "filter_tracked_mcf/hosts/cli/file_error.h"
#include "filter_tracked_mcf/hosts/cli/output_file.h"
#include "tests/cli/temporary_folder.h"

namespace tracked_mcf {
namespace {

TEST(OutputFileOnWindows, LeavesAFileThatAnotherProgramHasOpen) {
    const TemporaryFolder folder;
    write_file(folder / "a.ply", "before");
    {
        const std::ifstream reader(folder / "a.ply");
        EXPECT_THROW(commit(folder / "a.ply", "after"), UnwritableFile);
    }
    EXPECT_EQ(read_file(folder / "a.ply"), "before");
    const std::filesystem::directory_iterator files(folder.path());
    EXPECT_EQ(std::distance(files, {}), 1) << "nothing temporary stays";
    commit(folder / "a.ply", "after");
    EXPECT_EQ(read_file(folder / "a.ply"), "after");
}

}  // namespace
}  // namespace tracked_mcf
