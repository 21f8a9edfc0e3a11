#pragma once

#include <atomic>
#include <cstdint>
#include <utility>

#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/raw_vector.h"

namespace tracked_mcf {

/// DisjointSets in which any number of threads may unite at once. A set is represented by its
/// smallest member here, too, so nothing depends on who comes first.
class ConcurrentSets {
public:
    explicit ConcurrentSets(std::int32_t count) : parents_(static_cast<std::size_t>(count)) {
        parallel_for_rows(count, [&](std::int32_t i) { parents_[i].store(i, kOrder); });
    }

    void unite(std::int32_t a, std::int32_t b) {
        for (;;) {
            a = find(a);
            b = find(b);
            if (a == b) return;
            if (a > b) std::swap(a, b);
            // Another thread may have given b, until now a representative, a parent.
            std::int32_t expected = b;
            if (parents_[b].compare_exchange_weak(expected, a, kOrder)) return;
        }
    }

    /// The smallest member of the set that holds `member`, when no thread unites.
    std::int32_t find(std::int32_t member) {
        std::int32_t parent = parents_[member].load(kOrder);
        while (parent != member) {
            const std::int32_t grandparent = parents_[parent].load(kOrder);
            // Whatever others do meanwhile, this stays an ancestor.
            if (grandparent != parent) parents_[member].store(grandparent, kOrder);
            member = grandparent;
            parent = parents_[member].load(kOrder);
        }
        return member;
    }

private:
    static constexpr std::memory_order kOrder = std::memory_order_relaxed;

    RawVector<std::atomic<std::int32_t>> parents_;  ///< no larger than the member
};

}  // namespace tracked_mcf
