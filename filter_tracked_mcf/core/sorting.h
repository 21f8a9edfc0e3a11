#pragma once

#include <cstdint>
#include <vector>

namespace tracked_mcf {

/// A key to sort by, and what goes with it.
struct KeyValue {
    std::uint64_t key;
    std::uint64_t value;
};

/// Sorts a vector by key(item), an unsigned number, keeping the order of items with equal keys: a
/// radix sort in parallel.
template <class Items, class Key>
void sort_by(Items& items, const Key& key);

/// Sorts a vector of items that have a `key`.
template <class Items>
void sort_by_key(Items& items) {
    sort_by(items, [](const auto& item) { return item.key; });
}

/// The inverse of a map from items to groups: members(g) lists, in increasing order, the items
/// whose group is g.
class Groups {
public:
    Groups() = default;
    /// `group_of[item]` in [0, group_count).
    Groups(const std::vector<std::int32_t>& group_of, std::int32_t group_count);

    struct Members {
        const std::int32_t* first;
        const std::int32_t* last;
        const std::int32_t* begin() const { return first; }
        const std::int32_t* end() const { return last; }
    };
    Members members(std::int32_t group) const {
        return {items_.data() + begin_[group], items_.data() + begin_[group + 1]};
    }

    /// The members of all groups, one group after the other, and where each group begins, and the
    /// end.
    const std::int32_t* items() const { return items_.data(); }
    const std::int64_t* begins() const { return begin_.data(); }

private:
    std::vector<std::int64_t> begin_;
    std::vector<std::int32_t> items_;
};

}  // namespace tracked_mcf

#include "filter_tracked_mcf/core/radix_sort.h"
