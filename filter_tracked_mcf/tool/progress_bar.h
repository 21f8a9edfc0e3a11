#pragma once

#include <chrono>
#include <iosfwd>
#include <string_view>

namespace tracked_mcf {

/// A line on a terminal that fills up while the work goes on, and is wiped in the end.
class ProgressBar {
public:
    explicit ProgressBar(std::ostream& terminal) : terminal_(terminal) {}
    ~ProgressBar();

    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// Redraws, ten times a second at most: what is more often costs time and shows nothing.
    void show(double fraction, std::string_view phase);

private:
    using Clock = std::chrono::steady_clock;

    std::ostream& terminal_;
    Clock::time_point next_ = Clock::now();
    bool shown_ = false;
};

}  // namespace tracked_mcf
