#pragma once

#include <cstdint>
#include <vector>

namespace tracked_mcf {

/// A key to sort by, and what goes with it.
struct KeyValue {
    std::uint64_t key;
    std::uint64_t value;
};

/// Sorts by key, keeping the order of equal keys (a radix sort).
void sort_by_key(std::vector<KeyValue>& pairs);

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
