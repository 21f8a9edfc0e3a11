// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/progress_bar.h"

#include <gtest/gtest.h>

#include <chrono>
#include <sstream>

namespace tracked_mcf {
namespace {

TEST(ProgressBar, ShowsFractionAndPhaseAndWipesItselfInTheEnd) {
    std::ostringstream terminal;
    {
        ProgressBar bar(terminal);
        bar.show(0.5, "Step 5 of 10");
        EXPECT_EQ(terminal.str(), "\r\033[K[###############...............] 50 %, Step 5 of 10");
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

TEST(ProgressBar, GoesOnBetweenReportsAndTellsTheTimeLeft) {
    using std::chrono::seconds;
    std::ostringstream terminal;
    const ProgressBar::Clock::time_point start;
    ProgressBar bar(terminal, start);
    const auto shown = [&](double fraction, int second) {
        terminal.str("");
        bar.show(fraction, "", start + seconds(second));
        const std::string line = terminal.str();
        return line.substr(line.find(']') + 2);
    };
    EXPECT_EQ(shown(0, 1), "0 %, ");
    EXPECT_EQ(shown(0.1, 10), "10 %, 90 s left, ");
    EXPECT_EQ(shown(0.1, 15), "15 %, 85 s left, ");
    EXPECT_EQ(shown(0.12, 20), "15 %, 2 min left, ") << "the bar never goes back";
    EXPECT_EQ(shown(0.5, 4000), "50 %, 67 min left, ");
    EXPECT_EQ(shown(0.5, 100000), "99 %, 17 min left, ") << "only a report ends the bar";
    EXPECT_EQ(shown(1, 100001), "100 %, 0 s left, ");
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
              "\r\033[K[" + std::string(30, '#') + "] 100 %, " + std::string(26, 'x'));
}

}  // namespace
}  // namespace tracked_mcf
