// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/plan/memory_check.h"

#include <string>

#include "filter_tracked_mcf/core/errors.h"

namespace tracked_mcf {

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
                             bytes_in_words(flow_bytes(depth)) + " of memory, but only " +
                             bytes_in_words(static_cast<double>(available_)) + " are free.";
    if (less == 0) {
        throw NotEnoughMemory(need +
                              " No depth would fit: smooth a simplified mesh, or a part of it.");
    }
    throw NotEnoughMemory(need + " Choose depth " + std::to_string(less) +
                          (less > 1 ? " or less" : "") + ", which needs about " +
                          bytes_in_words(flow_bytes(less)) +
                          ", or smooth a simplified mesh or a part of it.");
}

}  // namespace tracked_mcf
