// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/parallel/progress_meter.h"

#include <algorithm>
#include <utility>

#include "filter_tracked_mcf/core/errors.h"

namespace tracked_mcf {

namespace {

/// The meter of this thread, or null.
thread_local ProgressMeter* current_meter = nullptr;

/// Sets the thread's meter for the scope's life.
class MeterScope {
public:
    explicit MeterScope(ProgressMeter* meter) : previous_(std::exchange(current_meter, meter)) {}
    ~MeterScope() { current_meter = previous_; }
    MeterScope(const MeterScope&) = delete;
    MeterScope& operator=(const MeterScope&) = delete;

private:
    ProgressMeter* previous_;
};

}  // namespace

ProgressMeter::ProgressMeter(const Progress& progress, Clock::duration interval)
    : progress_(progress),
      interval_(interval),
      hidden_(std::exchange(current_meter, progress ? this : nullptr)),
      next_call_(Clock::now() + interval) {}

ProgressMeter::~ProgressMeter() {
    current_meter = hidden_;
}

void ProgressMeter::advance(double share) {
    const double in_range = share > 0 ? std::min(share, 1.0) : 0;  // 0 if share is NaN
    const double fraction = span_begin_ + in_range * (span_end_ - span_begin_);
    fraction_ = std::clamp(fraction, fraction_, 1.0);
}

void ProgressMeter::call() {
    const MeterScope none(nullptr);
    if (!progress_(fraction_, phase_)) throw Cancelled("Stopped as asked.");
    // The interval starts after the call, so that a slow callback leaves time for the work.
    next_call_ = Clock::now() + interval_;
}

ProgressSpan::ProgressSpan(double begin, double end) : meter_(current_meter) {
    if (meter_ == nullptr) return;
    outer_begin_ = meter_->span_begin_;
    outer_end_ = meter_->span_end_;
    meter_->span_begin_ = outer_begin_ + begin * (outer_end_ - outer_begin_);
    meter_->span_end_ = outer_begin_ + end * (outer_end_ - outer_begin_);
    meter_->advance(0);
}

ProgressSpan::~ProgressSpan() {
    if (meter_ == nullptr) return;
    meter_->advance(1);
    meter_->span_begin_ = outer_begin_;
    meter_->span_end_ = outer_end_;
}

void advance_progress(double share) {
    if (current_meter != nullptr) current_meter->advance(share);
}

void enter_phase(double share, std::string phase) {
    if (current_meter == nullptr) return;
    current_meter->advance(share);
    current_meter->phase_ = std::move(phase);
    current_meter->call();
}

void poll_progress() {
    ProgressMeter* const meter = current_meter;
    if (meter != nullptr && ProgressMeter::Clock::now() >= meter->next_call_) meter->call();
}

}  // namespace tracked_mcf
