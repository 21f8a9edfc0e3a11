#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/raw_vector.h"

/// What sort_by of sorting.h is made of.
namespace tracked_mcf::radix {

/// At most this many bits of the keys are sorted by at a time: few enough that the places where
/// items go next stay in the cache.
inline constexpr unsigned kMostBits = 10;

/// Some bits of a key.
struct Digit {
    unsigned shift = 0;
    unsigned bits = 0;

    std::size_t count() const { return std::size_t{1} << bits; }
    std::size_t of(std::uint64_t key) const {
        return static_cast<std::size_t>(key >> shift) & (count() - 1);
    }
};

/// Digits, lowest first, that have all bits set in `varying`, all about as long.
std::vector<Digit> digits_of(std::uint64_t varying);

/// Items that one thread counts and moves at a time.
inline constexpr std::int64_t kItems = 1 << 15;

/// Calls body(block, begin, end) for the blocks of [0, count), in parallel.
template <class Body>
void for_each_block(std::int64_t count, const Body& body) {
    parallel_for((count + kItems - 1) / kItems, [&](std::int64_t block) {
        body(block, block * kItems, std::min(count, (block + 1) * kItems));
    });
}

/// The bits in which the items' keys differ.
template <class Items, class Key>
std::uint64_t varying_bits(const Items& items, const Key& key) {
    const auto count = static_cast<std::int64_t>(items.size());
    std::vector<std::uint64_t> varying(static_cast<std::size_t>(count / kItems + 1), 0);
    for_each_block(count, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
        std::uint64_t bits = 0;
        const std::uint64_t first = key(items[0]);
        for (std::int64_t i = begin; i < end; ++i) bits |= key(items[i]) ^ first;
        varying[block] = bits;
    });
    return std::accumulate(varying.begin(), varying.end(), std::uint64_t{0},
                           [](std::uint64_t a, std::uint64_t b) { return a | b; });
}

/// Counts become the places where the first of them goes: those with smaller digits go before, and
/// of the same digit those of earlier blocks.
void counts_to_places(std::vector<std::size_t>& counts, std::size_t digits);

/// One stable counting sort.
template <class Items, class To, class Key>
void sort_by_digit(const Items& from, To& to, const Digit& digit, const Key& key) {
    const auto count = static_cast<std::int64_t>(from.size());
    const std::size_t digits = digit.count();
    std::vector<std::size_t> places(static_cast<std::size_t>(count / kItems + 1) * digits, 0);
    for_each_block(count, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
        std::size_t* const counts = places.data() + static_cast<std::size_t>(block) * digits;
        for (std::int64_t i = begin; i < end; ++i) ++counts[digit.of(key(from[i]))];
    });
    counts_to_places(places, digits);
    for_each_block(count, [&](std::int64_t block, std::int64_t begin, std::int64_t end) {
        std::size_t* const next = places.data() + static_cast<std::size_t>(block) * digits;
        for (std::int64_t i = begin; i < end; ++i) to[next[digit.of(key(from[i]))]++] = from[i];
    });
}

}  // namespace tracked_mcf::radix

namespace tracked_mcf {

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

}  // namespace tracked_mcf
