// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ostream>
#include <string>
#include <string_view>

namespace tracked_mcf {

/// A progress bar in one line of a terminal, with the time left. The destructor wipes it.
class ProgressBar {
public:
    using Clock = std::chrono::steady_clock;

    explicit ProgressBar(std::ostream& terminal, Clock::time_point start = Clock::now())
        : terminal_(terminal), start_(start), reported_at_(start), next_(start) {}

    ~ProgressBar() {
        if (shown_) terminal_ << kWipe << std::flush;
    }

    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// Redraws the bar, at most ten times a second.
    void show(double fraction, std::string_view phase, Clock::time_point now = Clock::now()) {
        advance(std::clamp(fraction, 0.0, 1.0), now);
        if (now < next_) return;
        next_ = now + std::chrono::milliseconds(100);
        shown_ = true;
        // Everything fits into 80 columns.
        constexpr std::size_t width = 30, phase_width = 26;
        const auto filled = static_cast<std::size_t>(fraction_ * width);
        terminal_ << kWipe << '[' << std::string(filled, '#') << std::string(width - filled, '.')
                  << "] " << static_cast<int>(fraction_ * 100) << " %, " << time_left(now)
                  << phase.substr(0, phase_width) << std::flush;
    }

private:
    /// Moves the cursor to the left margin and clears the line.
    static constexpr const char* kWipe = "\r\033[K";

    /// Some stages report only their end. Until the next report, the bar goes on at the mean speed.
    void advance(double reported, Clock::time_point now) {
        if (reported > reported_) {
            reported_ = reported;
            reported_at_ = now;
        }
        const double known = seconds(reported_at_), since = seconds(now) - known;
        const double expected = known > 0 ? reported_ * (1 + since / known) : reported_;
        fraction_ = std::max({fraction_, reported_, std::min(expected, 0.99)});
    }

    /// Empty in the first second, which says little about the others.
    std::string time_left(Clock::time_point now) const {
        const double elapsed = seconds(now);
        if (elapsed < 1 || fraction_ == 0) return {};
        const double left = elapsed * (1 - fraction_) / fraction_;
        const auto rounded = [](double number, const char* unit) {
            return std::to_string(std::lround(number)) + unit + " left, ";
        };
        if (left < 100) return rounded(left, " s");
        return left < 6000 ? rounded(left / 60, " min") : rounded(left / 3600, " h");
    }

    double seconds(Clock::time_point time) const {
        return std::chrono::duration<double>(time - start_).count();
    }

    std::ostream& terminal_;
    Clock::time_point start_, reported_at_, next_;
    double reported_ = 0, fraction_ = 0;
    bool shown_ = false;
};

}  // namespace tracked_mcf
