// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <utility>

#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"

namespace tracked_mcf {

/// A union-find structure over the numbers below a count, in which any number of threads may unite
/// at once. The smallest member represents a set, so the result does not depend on the order of the
/// unions.
class DisjointSets {
public:
    explicit DisjointSets(std::int32_t count) : parents_(static_cast<std::size_t>(count)) {
        parallel_for_rows(count, [&](std::int32_t i) { parents_[i].store(i, kOrder); });
    }

    void unite(std::int32_t a, std::int32_t b) {
        for (;;) {
            a = find(a);
            b = find(b);
            if (a == b) return;
            if (a > b) std::swap(a, b);
            // Fails if another thread has linked the representative b to a parent meanwhile.
            std::int32_t expected = b;
            if (parents_[b].compare_exchange_weak(expected, a, kOrder)) return;
        }
    }

    /// Returns the smallest member of the set of `member`. While other threads unite, the result
    /// may be out of date.
    std::int32_t find(std::int32_t member) {
        std::int32_t parent = parents_[member].load(kOrder);
        while (parent != member) {
            const std::int32_t grandparent = parents_[parent].load(kOrder);
            // An ancestor stays an ancestor, so other threads cannot make this store wrong.
            if (grandparent != parent) parents_[member].store(grandparent, kOrder);
            member = grandparent;
            parent = parents_[member].load(kOrder);
        }
        return member;
    }

private:
    /// Only the parents' values matter: no other data is published through them.
    static constexpr std::memory_order kOrder = std::memory_order_relaxed;

    RawVector<std::atomic<std::int32_t>> parents_;  ///< invariant: parents_[i] <= i
};

}  // namespace tracked_mcf
