// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

/// A sort key and the value that moves with it.
struct KeyValue {
    std::uint64_t key;
    std::uint64_t value;
};

/// The parts of sort_by: a least-significant-digit radix sort.
namespace radix {

/// Largest number of bits of a digit: the offsets of all digits still fit into the cache.
inline constexpr unsigned kMostBits = 10;

/// Some consecutive bits of a key.
struct Digit {
    unsigned shift = 0;
    unsigned bits = 0;

    std::size_t count() const { return std::size_t{1} << bits; }
    std::size_t of(std::uint64_t key) const {
        return static_cast<std::size_t>(key >> shift) & (count() - 1);
    }
};

/// Returns digits of about equal length, lowest first, that cover the bits set in `varying`.
std::vector<Digit> digits_of(std::uint64_t varying);

/// Items of a chunk, which one thread counts and moves.
inline constexpr std::int64_t kItems = 1 << 15;

/// Calls body(chunk, begin, end) for consecutive chunks that cover [0, count), in parallel.
template <class Body>
void for_each_chunk(std::int64_t count, const Body& body) {
    parallel_for((count + kItems - 1) / kItems, [&](std::int64_t chunk) {
        body(chunk, chunk * kItems, std::min(count, (chunk + 1) * kItems));
    });
}

/// Returns the bits in which the keys of the items differ; none if the items are sorted.
template <class Items, class Key>
std::uint64_t varying_bits(const Items& items, const Key& key) {
    const auto count = static_cast<std::int64_t>(items.size());
    std::vector<std::uint64_t> varying(static_cast<std::size_t>(count / kItems + 1), 0);
    std::vector<std::uint8_t> is_sorted(varying.size(), 1);
    for_each_chunk(count, [&](std::int64_t chunk, std::int64_t begin, std::int64_t end) {
        std::uint64_t bits = 0, before = key(items[std::max<std::int64_t>(begin - 1, 0)]);
        const std::uint64_t first = key(items[0]);
        bool rises = true;
        for (std::int64_t i = begin; i < end; ++i) {
            const std::uint64_t present = key(items[i]);
            bits |= present ^ first;
            rises = rises && before <= present;
            before = present;
        }
        varying[chunk] = bits;
        is_sorted[chunk] = rises ? 1 : 0;
    });
    if (std::find(is_sorted.begin(), is_sorted.end(), 0) == is_sorted.end()) return 0;
    return std::accumulate(varying.begin(), varying.end(), std::uint64_t{0},
                           [](std::uint64_t a, std::uint64_t b) { return a | b; });
}

/// Replaces counts by their exclusive prefix sum, in the order of the digits and, for equal digits,
/// of the chunks. counts[chunk * digits + digit] belongs to a chunk and a digit.
void counts_to_offsets(std::vector<std::size_t>& counts, std::size_t digits);

/// Sorts by one digit with a stable counting sort.
template <class Items, class To, class Key>
void sort_by_digit(const Items& from, To& to, const Digit& digit, const Key& key) {
    const auto count = static_cast<std::int64_t>(from.size());
    const std::size_t digits = digit.count();
    std::vector<std::size_t> offsets(static_cast<std::size_t>(count / kItems + 1) * digits, 0);
    for_each_chunk(count, [&](std::int64_t chunk, std::int64_t begin, std::int64_t end) {
        std::size_t* const counts = offsets.data() + static_cast<std::size_t>(chunk) * digits;
        for (std::int64_t i = begin; i < end; ++i) ++counts[digit.of(key(from[i]))];
    });
    counts_to_offsets(offsets, digits);
    for_each_chunk(count, [&](std::int64_t chunk, std::int64_t begin, std::int64_t end) {
        std::size_t* const next = offsets.data() + static_cast<std::size_t>(chunk) * digits;
        for (std::int64_t i = begin; i < end; ++i) to[next[digit.of(key(from[i]))]++] = from[i];
    });
}

}  // namespace radix

/// Sorts a vector by key(item), an unsigned number, with a stable parallel radix sort.
template <class Items, class Key>
void sort_by(Items& items, const Key& key) {
    const std::vector<radix::Digit> digits = radix::digits_of(radix::varying_bits(items, key));
    if (digits.empty()) return;
    Items buffer(items.size());
    for (const radix::Digit& digit : digits) {
        radix::sort_by_digit(items, buffer, digit, key);
        items.swap(buffer);
    }
}

/// Sorts a vector of items that have a member `key`.
template <class Items>
void sort_by_key(Items& items) {
    sort_by(items, [](const auto& item) { return item.key; });
}

/// Lists the items of each group, given the group of each item: the inverse of a map.
class Groups {
public:
    Groups() = default;
    /// Sorts the items by group_of[item], a number in [0, group_count).
    Groups(const std::vector<std::int32_t>& group_of, std::int32_t group_count);

    struct Members {
        const std::int32_t* first;
        const std::int32_t* last;
        const std::int32_t* begin() const { return first; }
        const std::int32_t* end() const { return last; }
    };
    /// Returns the items of a group in increasing order.
    Members members(std::int32_t group) const {
        return {items_.data() + begin_[group], items_.data() + begin_[group + 1]};
    }

private:
    std::vector<std::int64_t> begin_;
    std::vector<std::int32_t> items_;
};

}  // namespace tracked_mcf
