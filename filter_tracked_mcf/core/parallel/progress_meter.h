// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

#include "filter_tracked_mcf/core/progress.h"

namespace tracked_mcf {

/// Reports the progress of one thread's work to a callback.
///
/// A meter belongs to the thread that constructs it, for as long as it lives: the functions below
/// report to the calling thread's latest meter. They do nothing in a thread without a meter, so
/// the worker threads of a parallel loop never invoke the callback. While a callback runs, its
/// thread has no meter.
class ProgressMeter {
public:
    using Clock = std::chrono::steady_clock;

    /// Least time between two calls within a phase.
    static constexpr Clock::duration kInterval = std::chrono::milliseconds(50);

    /// `progress` must outlive the meter; an empty one is never called. With an interval of 0 every
    /// poll invokes the callback; tests use that to cancel at every poll.
    explicit ProgressMeter(const Progress& progress, Clock::duration interval = kInterval);
    ~ProgressMeter();
    ProgressMeter(const ProgressMeter&) = delete;
    ProgressMeter& operator=(const ProgressMeter&) = delete;

private:
    friend class ProgressSpan;
    friend void advance_progress(double share);
    friend void enter_phase(double share, std::string phase);
    friend void poll_progress();

    void advance(double share);
    void call();

    const Progress& progress_;
    Clock::duration interval_;
    ProgressMeter* hidden_;  ///< the thread's meter before this one
    double span_begin_ = 0, span_end_ = 1;
    double fraction_ = 0;
    std::string phase_;
    Clock::time_point next_call_;
};

/// Maps the shares that this thread reports, during the span's life, from [0, 1] to
/// [`begin`, `end`] of the enclosing span, or of the whole work. The destructor reports share 1.
class ProgressSpan {
public:
    ProgressSpan(double begin, double end);
    ~ProgressSpan();
    ProgressSpan(const ProgressSpan&) = delete;
    ProgressSpan& operator=(const ProgressSpan&) = delete;

private:
    ProgressMeter* meter_;
    double outer_begin_ = 0, outer_end_ = 1;
};

/// Reports that a share in [0, 1] of the innermost span is done. Never decreases the fraction.
/// Does not invoke the callback.
void advance_progress(double share);

/// Reports that a share is done and that a phase begins, named for the user. Invokes the callback.
/// Throws Cancelled if the callback returns false, and passes on what the callback throws.
void enter_phase(double share, std::string phase);

/// Invokes the callback if the interval is over, and throws like enter_phase(). Without a call it
/// takes some ten nanoseconds. Parallel loops poll at every chunk (parallel.h).
void poll_progress();

/// Polls progress within a chunk of a parallel loop whose work has no bound, such as a triangle
/// with millions of fragments. The loops themselves poll at every chunk (parallel.h).
class Pacer {
public:
    /// Reports work worth `items` light items. Throws like poll_progress().
    void did(std::int64_t items) {
        left_ -= items;
        if (left_ > 0) return;
        left_ = kItemsPerPoll;
        poll_progress();
    }

private:
    /// Light items between two polls. All of them take some microseconds; a poll takes as long as
    /// about ten items.
    static constexpr std::int64_t kItemsPerPoll = 4096;

    std::int64_t left_ = kItemsPerPoll;
};

}  // namespace tracked_mcf
