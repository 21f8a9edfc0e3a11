#include "filter_tracked_mcf/tool/progress_bar.h"

#include <algorithm>
#include <ostream>
#include <string>

namespace tracked_mcf {

namespace {

// Together they fit into the 80 columns that every terminal has.
constexpr int kBarWidth = 30;
constexpr std::size_t kPhaseWidth = 40;

// Terminals take this as: to the left margin, and clear what follows.
constexpr const char* kWipe = "\r\033[K";

}  // namespace

ProgressBar::~ProgressBar() {
    if (shown_) terminal_ << kWipe << std::flush;
}

void ProgressBar::show(double fraction, std::string_view phase) {
    if (Clock::now() < next_) return;
    next_ = Clock::now() + std::chrono::milliseconds(100);
    shown_ = true;
    fraction = std::clamp(fraction, 0.0, 1.0);
    const int filled = static_cast<int>(fraction * kBarWidth);
    const int percent = static_cast<int>(fraction * 100);
    terminal_ << kWipe << '[' << std::string(static_cast<std::size_t>(filled), '#')
              << std::string(static_cast<std::size_t>(kBarWidth - filled), '.') << "] " << percent
              << " % " << phase.substr(0, kPhaseWidth) << std::flush;
}

}  // namespace tracked_mcf
