#pragma once

#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/interruptible.h"

namespace tracked_mcf {

/// The numbers below a count, at first each in a set of its own, as sets are united. A set is
/// represented by its smallest member, so nothing depends on the order of the unions.
class DisjointSets {
public:
    explicit DisjointSets(std::int32_t count) {
        parents_.reserve(static_cast<std::size_t>(count));
        serial_for(count, [&](std::int64_t member) {
            parents_.push_back(static_cast<std::int32_t>(member));
        });
    }

    /// Begins again with this count, a small one.
    void reset(std::int32_t count) {
        parents_.resize(static_cast<std::size_t>(count));
        std::iota(parents_.begin(), parents_.end(), 0);
    }

    /// The smallest member of the set that holds `member`.
    std::int32_t find(std::int32_t member) {
        while (parents_[member] != member) {
            parents_[member] = parents_[parents_[member]];
            member = parents_[member];
        }
        return member;
    }

    /// Whether they were not in one set before.
    bool unite(std::int32_t a, std::int32_t b) {
        a = find(a);
        b = find(b);
        if (a < b) {
            parents_[b] = a;
        } else {
            parents_[a] = b;
        }
        return a != b;
    }

    /// find() of every member.
    std::vector<std::int32_t> representatives() && {
        // Parents are never larger than their children, so theirs is settled when it is asked for.
        serial_for(static_cast<std::int64_t>(parents_.size()),
                   [&](std::int64_t member) { parents_[member] = parents_[parents_[member]]; });
        return std::move(parents_);
    }

private:
    std::vector<std::int32_t> parents_;
};

}  // namespace tracked_mcf
