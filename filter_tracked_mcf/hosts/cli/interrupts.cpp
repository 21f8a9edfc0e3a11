// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/interrupts.h"

#include <atomic>

#include "filter_tracked_mcf/hosts/cli/system.h"

namespace tracked_mcf {

namespace {

// Signal handlers may use atomics only if they have no lock. The order of all operations is total:
// either the handler sees no hold, or the last hold sees the signal.
static_assert(std::atomic<int>::is_always_lock_free);
std::atomic<int> holds{0};
std::atomic<int> received{0};  ///< the signal's number, or 0

extern "C" void on_interrupt(int number) {
    received = number;
    if (holds == 0) die_of_interrupt(number);
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
    if (++holds == 1 && interrupted()) die_of_interrupt(received);
}

InterruptHold::~InterruptHold() {
    if (--holds == 0 && interrupted()) die_of_interrupt(received);
}

}  // namespace tracked_mcf
