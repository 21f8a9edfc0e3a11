// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/tool/interrupts.h"

#include <atomic>
#include <cstdlib>

#include "filter_tracked_mcf/tool/system.h"

namespace tracked_mcf {

namespace {

// Signal handlers may use atomics only if they have no lock. The order of all operations is total:
// either the handler sees no hold, or the last hold sees the signal.
static_assert(std::atomic<int>::is_always_lock_free);
std::atomic<int> holds{0};
std::atomic<int> received{0};  ///< the signal's number, or 0

/// Ends the program without destructors or buffers, which a handler must not touch.
[[noreturn]] void end_program() {
    std::_Exit(128 + received);
}

extern "C" void on_interrupt(int number) {
    received = number;
    if (holds == 0) end_program();
}

}  // namespace

void handle_interrupts() {
    call_on_interrupts(on_interrupt);
}

bool interrupted() {
    return received != 0;
}

InterruptHold::InterruptHold() {
    // Another thread may run the handler and have seen no hold. It is about to end the program.
    if (++holds == 1 && interrupted()) end_program();
}

InterruptHold::~InterruptHold() {
    if (--holds == 0 && interrupted()) end_program();
}

}  // namespace tracked_mcf
