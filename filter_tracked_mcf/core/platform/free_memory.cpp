// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/platform/process_memory.h"

#include <cstdlib>
#include <iomanip>
#include <locale>
#include <sstream>

#include "filter_tracked_mcf/core/errors.h"

namespace tracked_mcf {

std::string bytes_in_words(double bytes) {
    const bool large = bytes >= 1e9;
    const double number = bytes / (large ? 1e9 : 1e6);
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << std::fixed << std::setprecision(number < 9.95 ? 1 : 0) << number
         << (large ? " GB" : " MB");
    return text.str();
}

namespace {

constexpr const char* kVariable = "TRACKED_MCF_FREE_MEMORY";

/// Returns how many bytes are free; 0 if nobody knows.
double free_memory_bytes() {
    const char* const value = std::getenv(kVariable);
    if (value == nullptr || *value == '\0') return static_cast<double>(available_memory_bytes());
    std::istringstream text(value);
    text.imbue(std::locale::classic());
    double bytes = 0;
    if (text >> bytes && text.eof() && bytes > 0) return bytes;
    throw InvalidParameter("The environment variable " + std::string(kVariable) + " is \"" + value +
                           "\"; give the number of bytes that are free, or unset it.");
}

}  // namespace

void check_free_memory(double bytes, const std::string& task, const std::string& advice) {
    const double available = free_memory_bytes();
    if (available == 0 || bytes <= available) return;
    throw NotEnoughMemory(task + " would need about " + bytes_in_words(bytes) +
                          " of memory, but only " + bytes_in_words(available) + " are free. " +
                          advice + " If more are free, set " + kVariable + " to their number.");
}

}  // namespace tracked_mcf
