// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/memory/process_memory.h"

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

void check_free_memory(double bytes, const std::string& task, const std::string& advice) {
    const auto available = static_cast<double>(available_memory_bytes());
    if (available == 0 || bytes <= available) return;
    throw NotEnoughMemory(task + " would need about " + bytes_in_words(bytes) +
                          " of memory, but only " + bytes_in_words(available) + " are free. " +
                          advice);
}

}  // namespace tracked_mcf
