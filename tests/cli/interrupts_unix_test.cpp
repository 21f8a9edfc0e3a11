// SPDX-License-Identifier: GPL-3.0-or-later
/// An interrupt ends the program and leaves the folder of the output as it was.

#include "filter_tracked_mcf/hosts/cli/interrupts.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "filter_tracked_mcf/hosts/cli/output_file.h"
#include "tests/cli/temporary_folder.h"

namespace tracked_mcf {
namespace {

using ::testing::ExitedWithCode;
using ::testing::KilledBySignal;

const std::string kTriangle = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

std::vector<std::string> names_in(const TemporaryFolder& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        names.push_back(entry.path().filename());
    }
    std::sort(names.begin(), names.end());
    return names;
}

/// Shells ignore SIGINT in what they start in the background, and nohup ignores SIGHUP.
void ignore_no_interrupts() {
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, SIG_DFL);
}

TEST(InterruptsDeathTest, EndTheProgramAtOnceUnlessTheyAreHeld) {
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        const auto raise_alone = [&] {
            ignore_no_interrupts();
            handle_interrupts();
            std::raise(number);
        };
        EXPECT_EXIT(raise_alone(), KilledBySignal(number), "");
        const auto raise_in_holds = [&] {
            ignore_no_interrupts();
            handle_interrupts();
            const InterruptHold outer;
            {
                const InterruptHold inner;
                std::raise(number);
            }
            std::fputs("held", stderr);
        };
        EXPECT_EXIT(raise_in_holds(), KilledBySignal(number), "held");
    }
}

TEST(InterruptsDeathTest, AreIgnoredIfTheyWereBefore) {
    const auto raise_ignored = [] {
        std::signal(SIGHUP, SIG_IGN);
        handle_interrupts();
        std::raise(SIGHUP);
        std::_Exit(interrupted() ? 1 : 0);
    };
    EXPECT_EXIT(raise_ignored(), ExitedWithCode(0), "");
}

TEST(InterruptsDeathTest, RemoveStagedFiles) {
    const TemporaryFolder folder;
    write_file(folder / "a.ply", "before");
    const auto interrupt_writing = [&] {
        handle_interrupts();
        OutputFile mesh(folder / "a.ply"), report(folder / "r.json");
        write_text(mesh, "half");
        write_text(report, "half");
        std::raise(SIGTERM);
    };
    EXPECT_EXIT(interrupt_writing(), KilledBySignal(SIGTERM), "");
    EXPECT_EQ(names_in(folder), std::vector<std::string>{"a.ply"});
    EXPECT_EQ(read_file(folder / "a.ply"), "before");
}

/// A run of the program with a long job that reads a pipe.
class InterruptedRun : public ::testing::Test {
protected:
    void SetUp() override {
        write_file(folder_ / "b.off", "before");
        ASSERT_EQ(mkfifo((folder_ / "pipe.off").c_str(), 0600), 0);
        program_ = fork();
        if (program_ == 0) {
            ignore_no_interrupts();
            if (chdir(folder_.path().c_str()) != 0) std::_Exit(1);
            execl(TRACKED_MCF_PROGRAM, "tracked_mcf", "pipe.off", "b.off", "--depth", "8",
                  "--boundary", "free", "--step-size", "1e-12", "--iterations", "1000000", nullptr);
            std::_Exit(1);
        }
        // Returns once the program has opened the pipe.
        pipe_ = open((folder_ / "pipe.off").c_str(), O_WRONLY);
    }

    /// Interrupts the program. Returns the signal of which it dies, or 0: a shell goes on with its
    /// loop after a program that exits.
    int death_after(int signal) const {
        kill(program_, signal);
        int status = 0;
        waitpid(program_, &status, 0);
        return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    }

    void expect_nothing_changed() const {
        EXPECT_EQ(names_in(folder_), (std::vector<std::string>{"b.off", "pipe.off"}));
        EXPECT_EQ(read_file(folder_ / "b.off"), "before");
    }

    TemporaryFolder folder_;
    pid_t program_ = -1;
    int pipe_ = -1;
};

TEST_F(InterruptedRun, EndsWhileItReads) {
    EXPECT_EQ(death_after(SIGHUP), SIGHUP);
    close(pipe_);
    expect_nothing_changed();
}

TEST_F(InterruptedRun, EndsWhileTheSurfaceFlows) {
    EXPECT_EQ(write(pipe_, kTriangle.data(), kTriangle.size()),
              static_cast<ssize_t>(kTriangle.size()));
    close(pipe_);
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    EXPECT_EQ(death_after(SIGINT), SIGINT);
    expect_nothing_changed();
}

}  // namespace
}  // namespace tracked_mcf
