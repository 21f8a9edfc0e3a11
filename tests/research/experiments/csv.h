// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iostream>
#include <type_traits>

namespace tracked_mcf::experiments {

/// Prints values as a line of CSV on standard output and flushes, so that a long run can be
/// followed. Text is quoted: it may contain commas, but no quotes.
template <typename... Values>
void print_row(const Values&... values) {
    const char* separator = "";
    const auto print = [&separator](const auto& value) {
        std::cout << separator;
        separator = ",";
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>) {
            std::cout << value;
        } else {
            std::cout << '"' << value << '"';
        }
    };
    std::cout.precision(8);
    (print(values), ...);
    std::cout << '\n' << std::flush;
}

}  // namespace tracked_mcf::experiments
