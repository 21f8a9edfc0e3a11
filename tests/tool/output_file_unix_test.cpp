// SPDX-License-Identifier: GPL-3.0-or-later
/// Modes, owners, links and devices of Unix.

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "filter_tracked_mcf/tool/file_error.h"
#include "filter_tracked_mcf/tool/output_file.h"
#include "tests/tool/temporary_folder.h"

namespace tracked_mcf {
namespace {

namespace fs = std::filesystem;

std::size_t file_count(const TemporaryFolder& folder) {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()));
}

/// Returns the exit code of a process of its own, which `work` returns.
template <class Work>
int code_of_process(Work work) {
    const pid_t process = fork();
    if (process == 0) {
        try {
            std::_Exit(work());
        } catch (...) {
            std::_Exit(99);
        }
    }
    int status = 0;
    waitpid(process, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

void commit(const fs::path& path, const std::string& content) {
    OutputFile output(path);
    output.stage_text(content);
    output.commit();
}

TEST(OutputFileOnUnix, ReplacesTheFileThatALinkLeadsTo) {
    const TemporaryFolder folder;
    write_file(folder / "real.ply", "before");
    fs::create_symlink(folder / "real.ply", folder / "link.ply");
    OutputFile output(folder / "link.ply");
    output.stage_text("after");
    output.commit();
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

TEST(OutputFileOnUnix, KeepsTheOwner) {
    if (geteuid() != 0) GTEST_SKIP() << "only root can give files away";
    const TemporaryFolder folder;
    write_file(folder / "a.ply", "before");
    ASSERT_EQ(chown((folder / "a.ply").c_str(), 1234, 5678), 0);
    fs::permissions(folder / "a.ply", fs::perms{06755});
    commit(folder / "a.ply", "after");
    struct stat status {};
    ASSERT_EQ(stat((folder / "a.ply").c_str(), &status), 0);
    EXPECT_EQ(status.st_uid, 1234u);
    EXPECT_EQ(status.st_gid, 5678u);
    EXPECT_EQ(status.st_mode & 07777u, 06755u);
}

TEST(OutputFileOnUnix, KeepsTheOwnerWhereOnlyItsContentMayChange) {
    if (geteuid() != 0) GTEST_SKIP() << "only root can become another user";
    const TemporaryFolder folder;
    write_file(folder / "a.ply", "before");
    fs::permissions(folder / "a.ply", fs::perms{0666});
    fs::permissions(folder.path(), fs::perms{0777});
    EXPECT_EQ(code_of_process([&] {
                  if (setgid(1234) != 0 || setuid(1234) != 0) return 1;
                  commit(folder / "a.ply", "after");
                  return 0;
              }),
              0);
    struct stat status {};
    ASSERT_EQ(stat((folder / "a.ply").c_str(), &status), 0);
    EXPECT_EQ(status.st_uid, 0u);
    EXPECT_EQ(status.st_mode & 0777u, 0666u);
    EXPECT_EQ(read_file(folder / "a.ply"), "after");
    EXPECT_EQ(file_count(folder), 1u);
}

TEST(OutputFileOnUnix, AFullDiskKeepsTheContentOfHardLinks) {
    const TemporaryFolder folder;
    constexpr int cannot_mount = 77;
    // The disk has space for both versions side by side, but not for the old one to grow as well.
    const int code = code_of_process([&] {
        if (unshare(CLONE_NEWNS) != 0 ||
            mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
            mount("none", folder.path().c_str(), "tmpfs", 0, "size=92k") != 0) {
            return cannot_mount;
        }
        const std::string before(20000, 'x');
        write_file(folder / "a.ply", before);
        fs::create_hard_link(folder / "a.ply", folder / "b.ply");
        try {
            commit(folder / "a.ply", std::string(60000, 'y'));
        } catch (const UnwritableFile& error) {
            std::fputs(error.what(), stderr);
            return read_file(folder / "b.ply") == before && file_count(folder) == 2 ? 0 : 1;
        }
        return 2;
    });
    if (code == cannot_mount) GTEST_SKIP() << "only root can mount a small disk";
    EXPECT_EQ(code, 0);
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
