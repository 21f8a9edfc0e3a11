// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/memory/memory_check.h"

#include <iomanip>
#include <locale>
#include <sstream>
#include <string>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/memory/process_memory.h"

namespace tracked_mcf {

namespace {

/// Returns a number such as "3.7 GB", "37 GB" or "370 MB".
std::string in_words(double bytes) {
    const bool large = bytes >= 1e9;
    const double number = bytes / (large ? 1e9 : 1e6);
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << std::fixed << std::setprecision(number < 9.95 ? 1 : 0) << number
         << (large ? " GB" : " MB");
    return text.str();
}

}  // namespace

void check_free_memory(double bytes, const std::string& task, const std::string& advice) {
    const auto available = static_cast<double>(available_memory_bytes());
    if (available == 0 || bytes <= available) return;
    throw NotEnoughMemory(task + " would need about " + in_words(bytes) + " of memory, but only " +
                          in_words(available) + " are free. " + advice);
}

bool MemoryCheck::is_free(double bytes) const {
    return available_ == 0 || bytes <= static_cast<double>(available_);
}

double MemoryCheck::flow_bytes(int depth) const {
    return estimate_flow_bytes(size_, with_depth(cube_, depth), parameters_);
}

void MemoryCheck::before_flow(int depth) const {
    if (!fits(depth)) refuse(depth);
}

void MemoryCheck::before_clipping(int depth) const {
    if (!is_free(estimate_clip_bytes(size_, with_depth(cube_, depth), parameters_))) refuse(depth);
}

void MemoryCheck::refuse(int depth) const {
    int less = depth - 1;
    while (less > 0 && !fits(less)) --less;
    const std::string need = "Depth " + std::to_string(depth) + " would need about " +
                             in_words(flow_bytes(depth)) + " of memory, but only " +
                             in_words(static_cast<double>(available_)) + " are free.";
    if (less == 0) {
        throw NotEnoughMemory(need +
                              " No depth would fit: smooth a simplified mesh, or a part of it.");
    }
    throw NotEnoughMemory(need + " Choose depth " + std::to_string(less) +
                          (less > 1 ? " or less" : "") + ", which needs about " +
                          in_words(flow_bytes(less)) +
                          ", or smooth a simplified mesh or a part of it.");
}

MemoryCheck check_of(const SurfaceSize& size, const Grid& cube, const FlowParameters& parameters) {
    return {size, cube, parameters, available_memory_bytes()};
}

}  // namespace tracked_mcf
