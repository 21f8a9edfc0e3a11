// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "tests/research/experiments/csv.h"
#include "tests/support/process_time.h"

namespace tracked_mcf::benchmark {

/// Prints the columns of all subcommands: a quantity, its step (from 1; 0 for the whole run), and
/// its value.
inline void print_header() {
    experiments::print_row("quantity", "step", "value");
}

template <class Value>
void print_quantity(const std::string& quantity, int step, Value value) {
    experiments::print_row(quantity, step, value);
}

/// Prints NAME_seconds and NAME_cpu_seconds.
inline void print_seconds(const std::string& name, int step, const Seconds& seconds) {
    print_quantity(name + "_seconds", step, seconds.wall);
    print_quantity(name + "_cpu_seconds", step, seconds.cpu);
}

}  // namespace tracked_mcf::benchmark
