// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <chrono>
#include <ostream>
#include <string>
#include <string_view>

namespace tracked_mcf {

/// A progress bar in one line of a terminal. The destructor wipes it.
class ProgressBar {
public:
    explicit ProgressBar(std::ostream& terminal) : terminal_(terminal) {}

    ~ProgressBar() {
        if (shown_) terminal_ << kWipe << std::flush;
    }

    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// Redraws the bar, at most ten times a second.
    void show(double fraction, std::string_view phase) {
        if (Clock::now() < next_) return;
        next_ = Clock::now() + std::chrono::milliseconds(100);
        shown_ = true;
        // Bar, percentage and phase fit into 80 columns.
        constexpr std::size_t width = 30, phase_width = 40;
        fraction = std::clamp(fraction, 0.0, 1.0);
        const auto filled = static_cast<std::size_t>(fraction * width);
        terminal_ << kWipe << '[' << std::string(filled, '#') << std::string(width - filled, '.')
                  << "] " << static_cast<int>(fraction * 100) << " % "
                  << phase.substr(0, phase_width) << std::flush;
    }

private:
    using Clock = std::chrono::steady_clock;

    /// Moves the cursor to the left margin and clears the line.
    static constexpr const char* kWipe = "\r\033[K";

    std::ostream& terminal_;
    Clock::time_point next_ = Clock::now();
    bool shown_ = false;
};

}  // namespace tracked_mcf
