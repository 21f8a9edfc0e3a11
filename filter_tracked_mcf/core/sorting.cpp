#include "filter_tracked_mcf/core/sorting.h"

#include "filter_tracked_mcf/core/interruptible.h"

namespace tracked_mcf {

Groups::Groups(const std::vector<std::int32_t>& group_of, std::int32_t group_count)
    : begin_(static_cast<std::size_t>(group_count) + 1, 0) {
    resize(items_, static_cast<std::int64_t>(group_of.size()));
    for_each_item(group_of, [&](std::int32_t group) { ++begin_[group + 1]; });
    for (std::int32_t group = 0; group < group_count; ++group) begin_[group + 1] += begin_[group];
    std::vector<std::int64_t> next(begin_.begin(), begin_.end() - 1);
    serial_for(static_cast<std::int64_t>(group_of.size()), [&](std::int64_t item) {
        items_[next[group_of[item]]++] = static_cast<std::int32_t>(item);
    });
}

}  // namespace tracked_mcf
