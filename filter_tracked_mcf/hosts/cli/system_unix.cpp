// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <csignal>
#include <initializer_list>

#include "filter_tracked_mcf/hosts/cli/system.h"

namespace tracked_mcf {

std::vector<std::string> utf8_arguments(int argc, const char* const* argv) {
    return {argv + (argc > 0 ? 1 : 0), argv + argc};
}

bool writes_to_terminal() {
    return isatty(STDERR_FILENO) != 0;
}

void let_writes_fail_at_file_limits() {
    std::signal(SIGXFSZ, SIG_IGN);
}

void call_on_interrupts(void (*handler)(int number)) {
    for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
        if (std::signal(number, SIG_IGN) != SIG_IGN) std::signal(number, handler);
    }
}

void die_of_interrupt(int number) {
    // Signal handlers may call both functions.
    std::signal(number, SIG_DFL);
    std::raise(number);
}

}  // namespace tracked_mcf
