#pragma once

#include <string>

#include "tests/benchmark/process_time.h"
#include "tests/experiments/csv.h"

namespace tracked_mcf::benchmark {

/// What all subcommands print: a quantity, the step that it is of (from 1; 0 for the whole), and
/// its value.
inline void print_header() {
    experiments::print_row("quantity", "step", "value");
}

template <class Value>
void print_quantity(const std::string& quantity, int step, Value value) {
    experiments::print_row(quantity, step, value);
}

/// As NAME_seconds and NAME_cpu_seconds.
inline void print_seconds(const std::string& name, int step, const Seconds& seconds) {
    print_quantity(name + "_seconds", step, seconds.wall);
    print_quantity(name + "_cpu_seconds", step, seconds.cpu);
}

}  // namespace tracked_mcf::benchmark
