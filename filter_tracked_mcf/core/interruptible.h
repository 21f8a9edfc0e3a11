#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/progress_meter.h"
#include "filter_tracked_mcf/core/raw_vector.h"

/// Serial work on as many items as a mesh has, during which progress is told and which can be
/// stopped (progress_meter.h). Parallel loops are so by themselves (parallel.h).
namespace tracked_mcf {

/// Light items from one poll to the next: a poll takes about as long as ten of them, and all of
/// them some microseconds.
inline constexpr std::int64_t kItemsPerPoll = 4096;

/// Calls body(i) for every i in [begin, end), in order.
template <class Body>
void serial_for(std::int64_t begin, std::int64_t end, const Body& body) {
    while (begin < end) {
        poll_progress();
        const std::int64_t block_end = std::min(end, begin + kItemsPerPoll);
        for (; begin < block_end; ++begin) body(begin);
    }
}

/// Calls body(i) for every i in [0, count), in order.
template <class Body>
void serial_for(std::int64_t count, const Body& body) {
    serial_for(0, count, body);
}

/// Calls body(item) for every item of a vector, in order.
template <class Item, class Allocator, class Body>
void for_each_item(const std::vector<Item, Allocator>& items, const Body& body) {
    serial_for(static_cast<std::int64_t>(items.size()), [&](std::int64_t i) { body(items[i]); });
}

/// Polls as work is done, for loops whose bodies may do very much.
class Pacer {
public:
    /// As much has been done as for this many light items.
    void did(std::int64_t items) {
        left_ -= items;
        if (left_ > 0) return;
        left_ = kItemsPerPoll;
        poll_progress();
    }

private:
    std::int64_t left_ = kItemsPerPoll;
};

/// items.resize(size): fresh memory is mapped and cleared as it is touched, which takes as long as
/// a loop over it.
template <class Item>
void resize(RawVector<Item>& items, std::int64_t size) {
    items.resize(static_cast<std::size_t>(size));  // neither mapped nor cleared yet
}
template <class Item>
void resize(std::vector<Item>& items, std::int64_t size) {
    constexpr std::int64_t bytes_per_poll = 1 << 20;
    constexpr std::int64_t piece = bytes_per_poll / sizeof(Item) + 1;
    items.reserve(static_cast<std::size_t>(size));
    for (auto end = static_cast<std::int64_t>(items.size()); end < size;) {
        poll_progress();
        end = std::min(size, end + piece);
        items.resize(static_cast<std::size_t>(end));
    }
    items.resize(static_cast<std::size_t>(size));
}

/// Appends a copy of all items.
template <class Item>
void append(const std::vector<Item>& items, std::vector<Item>& to) {
    to.reserve(to.size() + items.size());
    for_each_item(items, [&](const Item& item) { to.push_back(item); });
}

template <class Item>
std::vector<Item> copy_of(const std::vector<Item>& items) {
    std::vector<Item> copy;
    append(items, copy);
    return copy;
}

}  // namespace tracked_mcf
