// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

/// A flag for each item, initially false, that any number of threads may set at once.
class Marks {
public:
    explicit Marks(std::int64_t count) : marks_(static_cast<std::size_t>(count)) {
        parallel_for_chunks(count, [&](std::int64_t begin, std::int64_t end) {
            for (std::int64_t i = begin; i < end; ++i) marks_[i].store(0, kOrder);
        });
    }

    void set(std::int64_t i) {
        // Most flags are set many times; a store would invalidate the other cores' cache lines.
        if (marks_[i].load(kOrder) == 0) marks_[i].store(1, kOrder);
    }
    bool operator[](std::int64_t i) const { return marks_[i].load(kOrder) != 0; }

    /// Returns how many flags are set.
    std::int64_t count() const {
        return parallel_count(static_cast<std::int64_t>(marks_.size()),
                              [&](std::int64_t i) { return (*this)[i]; });
    }

    /// Returns 1 for every flag that is set, and 0 for the others.
    std::vector<std::uint8_t> flags() const {
        std::vector<std::uint8_t> flags(marks_.size());
        parallel_for_rows(static_cast<std::int64_t>(flags.size()),
                          [&](std::int32_t i) { flags[i] = marks_[i].load(kOrder); });
        return flags;
    }

private:
    /// A flag publishes no other data; the join of a parallel loop orders it before later reads.
    static constexpr std::memory_order kOrder = std::memory_order_relaxed;

    std::vector<std::atomic<std::uint8_t>> marks_;
};

}  // namespace tracked_mcf
