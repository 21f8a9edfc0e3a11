// SPDX-License-Identifier: GPL-3.0-or-later
/// Ctrl-C ends the program and leaves the folder of the output as it was.

#include <gtest/gtest.h>
#include <windows.h>

#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <optional>

#include "filter_tracked_mcf/hosts/cli/interrupts.h"
#include "filter_tracked_mcf/hosts/cli/output_file.h"
#include "tests/cli/temporary_folder.h"

namespace tracked_mcf {
namespace {

using ::testing::ExitedWithCode;

/// Presses Ctrl-C in a console that only this process has.
void press_keys() {
    FreeConsole();
    AllocConsole();
    GenerateConsoleCtrlEvent(CTRL_C_EVENT, 0);
}

/// Returns after the interrupt, or after ten seconds. Windows handles it on another thread.
void wait_for_interrupt() {
    for (int i = 0; i < 1000 && !interrupted(); ++i) Sleep(10);
}

TEST(InterruptsDeathTest, EndTheProgramAtOnceUnlessTheyAreHeld) {
    const auto press_alone = [] {
        handle_interrupts();
        press_keys();
        Sleep(10000);
        std::_Exit(1);
    };
    EXPECT_EXIT(press_alone(), ExitedWithCode(130), "");
    const auto press_in_holds = [] {
        handle_interrupts();
        const InterruptHold outer;
        {
            const InterruptHold inner;
            press_keys();
            wait_for_interrupt();
        }
        if (!interrupted()) std::_Exit(1);
        std::fputs("held", stderr);
    };
    EXPECT_EXIT(press_in_holds(), ExitedWithCode(130), "held");
}

TEST(InterruptsDeathTest, RemoveStagedFiles) {
    // The death test starts this test again in a process of its own, which takes the folder from
    // the environment.
    constexpr const char* variable = "TRACKED_MCF_TEST_FOLDER";
    std::optional<TemporaryFolder> folder;
    if (std::getenv(variable) == nullptr) {
        folder.emplace();
        write_file(*folder / "a.ply", "before");
        _putenv_s(variable, folder->path().u8string().c_str());
    }
    const auto interrupt_writing = [&] {
        const auto path = std::filesystem::u8path(std::getenv(variable));
        handle_interrupts();
        OutputFile mesh(path / "a.ply"), report(path / "r.json");
        write_text(mesh, "half");
        write_text(report, "half");
        press_keys();
        wait_for_interrupt();
    };
    EXPECT_EXIT(interrupt_writing(), ExitedWithCode(130), "");
    _putenv_s(variable, "");
    const std::filesystem::directory_iterator files(folder->path());
    EXPECT_EQ(std::distance(files, {}), 1) << "nothing temporary stays";
    EXPECT_EQ(read_file(*folder / "a.ply"), "before");
}

}  // namespace
}  // namespace tracked_mcf
