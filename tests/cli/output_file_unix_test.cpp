// SPDX-License-Identifier: GPL-3.0-or-later
/// Modes, links and devices of Unix.

#include <gtest/gtest.h>

#include "filter_tracked_mcf/hosts/cli/file_error.h"
#include "filter_tracked_mcf/hosts/cli/output_file.h"
#include "tests/cli/temporary_folder.h"

namespace tracked_mcf {
namespace {

namespace fs = std::filesystem;

TEST(OutputFileOnUnix, ReplacesTheFileThatALinkLeadsTo) {
    const TemporaryFolder folder;
    write_file(folder / "real.ply", "before");
    fs::create_symlink(folder / "real.ply", folder / "link.ply");
    commit(folder / "link.ply", "after");
    EXPECT_TRUE(fs::is_symlink(folder / "link.ply"));
    EXPECT_EQ(read_file(folder / "real.ply"), "after");
}

TEST(OutputFileOnUnix, CreatesTheFileThatALinkLeadsTo) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "sub");
    fs::create_symlink("sub/second.ply", folder / "first.ply");
    fs::create_symlink("../real.ply", folder / "sub/second.ply");
    commit(folder / "first.ply", "new");
    EXPECT_TRUE(fs::is_symlink(folder / "first.ply"));
    EXPECT_TRUE(fs::is_symlink(folder / "sub/second.ply"));
    EXPECT_FALSE(fs::is_symlink(folder / "real.ply"));
    EXPECT_EQ(read_file(folder / "real.ply"), "new");
}

TEST(OutputFileOnUnix, KeepsTheMode) {
    const TemporaryFolder folder;
    for (const unsigned mode : {0600u, 0664u, 0755u}) {
        write_file(folder / "a.ply", "before");
        fs::permissions(folder / "a.ply", fs::perms{mode});
        commit(folder / "a.ply", "after");
        EXPECT_EQ(read_file(folder / "a.ply"), "after");
        EXPECT_EQ(fs::status(folder / "a.ply").permissions(), fs::perms{mode});
    }
}

TEST(OutputFileOnUnix, OthersCannotReadWhatIsNotCommittedIfTheyCannotReadTheOldFile) {
    const TemporaryFolder folder;
    write_file(folder / "a.ply", "before");
    fs::permissions(folder / "a.ply", fs::perms{0600});
    OutputFile output(folder / "a.ply");
    write_text(output, "half");
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(folder.path())) {
        EXPECT_EQ(entry.status().permissions(), fs::perms{0600}) << entry;
        ++files;
    }
    EXPECT_EQ(files, 2u);
}

TEST(OutputFileOnUnix, ANewVersionHasNoSpecialBits) {
    const TemporaryFolder folder;
    write_file(folder / "a.ply", "before");
    fs::permissions(folder / "a.ply", fs::perms{06755});
    commit(folder / "a.ply", "after");
    EXPECT_EQ(fs::status(folder / "a.ply").permissions(), fs::perms{0755});
}

TEST(OutputFileOnUnix, NamesMayBeAsLongAsTheSystemAllows) {
    const TemporaryFolder folder;
    const std::string longest = std::string(251, 'a') + ".ply";
    commit(folder / longest, "mesh");
    EXPECT_EQ(read_file(folder / longest), "mesh");
    EXPECT_THROW(OutputFile(folder / ("a" + longest)), UnwritableFile);
}

TEST(OutputFileOnUnix, RefusesLinksThatLeadToThemselves) {
    const TemporaryFolder folder;
    fs::create_symlink("loop.ply", folder / "loop.ply");
    EXPECT_THROW(OutputFile(folder / "loop.ply"), UnwritableFile);
}

TEST(OutputFileOnUnix, RefusesDevicesAndFoldersOfTheSystem) {
    EXPECT_THROW(OutputFile("/dev/full"), UnwritableFile);
    EXPECT_THROW(OutputFile("/proc/a.ply"), UnwritableFile);
}

}  // namespace
}  // namespace tracked_mcf
