// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/tool/progress_bar.h"

#include <gtest/gtest.h>

#include <sstream>

namespace tracked_mcf {
namespace {

TEST(ProgressBar, ShowsFractionAndPhaseAndWipesItselfInTheEnd) {
    std::ostringstream terminal;
    {
        ProgressBar bar(terminal);
        bar.show(0.5, "Step 5 of 10");
        EXPECT_EQ(terminal.str(), "\r\033[K[###############...............] 50 % Step 5 of 10");
        terminal.str("");
    }
    EXPECT_EQ(terminal.str(), "\r\033[K");
}

TEST(ProgressBar, RedrawsTenTimesASecondAtMost) {
    std::ostringstream terminal;
    ProgressBar bar(terminal);
    bar.show(0.1, "first");
    bar.show(0.2, "second");
    EXPECT_EQ(terminal.str().find("second"), std::string::npos);
}

TEST(ProgressBar, LeavesNoTraceUnlessShown) {
    std::ostringstream terminal;
    { const ProgressBar bar(terminal); }
    EXPECT_EQ(terminal.str(), "");
}

TEST(ProgressBar, StaysOnOneLineOfEightyColumns) {
    std::ostringstream terminal;
    ProgressBar bar(terminal);
    bar.show(7, std::string(1000, 'x'));
    EXPECT_EQ(terminal.str(),
              "\r\033[K[" + std::string(30, '#') + "] 100 % " + std::string(40, 'x'));
}

}  // namespace
}  // namespace tracked_mcf
