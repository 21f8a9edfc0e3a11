#pragma once

#include <chrono>
#include <string>

#include "filter_tracked_mcf/core/progress.h"

namespace tracked_mcf {

/// Tells a callback how far the work of one thread has come.
///
/// While it lives it is the meter of the thread that made it: all that this thread does in the core
/// reports to it by the functions below. Those do nothing in a thread without a meter, so other
/// threads, which share the work of this one, never call its callback. Of two meters the one made
/// last counts; while a callback runs, none does.
class ProgressMeter {
public:
    using Clock = std::chrono::steady_clock;

    /// At most this long is waited until the callback is called again, plus what passes between two
    /// polls.
    static constexpr Clock::duration kInterval = std::chrono::milliseconds(50);

    /// `progress` must outlive this; an empty one is never called. With an interval of 0 every poll
    /// is a call: so tests reach all places at which the work can be stopped.
    explicit ProgressMeter(const Progress& progress, Clock::duration interval = kInterval);
    ~ProgressMeter();
    ProgressMeter(const ProgressMeter&) = delete;
    ProgressMeter& operator=(const ProgressMeter&) = delete;

    /// All is done: calls the callback with 1.
    void done();

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

/// While it lives, shares that this thread reports are shares of a part of the work: of that from
/// `begin` to `end`, which are themselves shares of the span around it, or of all. When it ends, so
/// has that part.
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

/// This share of the innermost span, in [0, 1], is done; taken back is nothing. Calls nothing.
void advance_progress(double share);

/// The same, and something else, in words for a person, is now being done. Calls the callback;
/// throws Cancelled if that returns false, and what it throws.
void enter_phase(double share, std::string phase);

/// Calls the callback if its time has come, and throws like enter_phase(). To be called every few
/// milliseconds at least; when there is nothing to do it takes some ten nanoseconds.
void poll_progress();

}  // namespace tracked_mcf
