#include "filter_tracked_mcf/core/sorting.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "filter_tracked_mcf/core/interruptible.h"

namespace tracked_mcf {

namespace {

constexpr unsigned kDigitBits = 11;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;

std::size_t digit(std::uint64_t key, unsigned shift) {
    return (key >> shift) & (kDigits - 1);
}

/// One stable counting sort by the digit at `shift`.
void sort_by_digit(const std::vector<KeyValue>& from, std::vector<KeyValue>& to, unsigned shift) {
    std::array<std::size_t, kDigits> next{};
    for_each_item(from, [&](const KeyValue& pair) { ++next[digit(pair.key, shift)]; });
    std::size_t begin = 0;
    for (std::size_t& entry : next) {
        const std::size_t count = entry;
        entry = begin;
        begin += count;
    }
    for_each_item(from, [&](const KeyValue& pair) { to[next[digit(pair.key, shift)]++] = pair; });
}

}  // namespace

void sort_by_key(std::vector<KeyValue>& pairs) {
    std::uint64_t used = 0;
    for_each_item(pairs, [&](const KeyValue& pair) { used |= pair.key; });
    std::vector<KeyValue> buffer;
    resize(buffer, static_cast<std::int64_t>(pairs.size()));
    for (unsigned shift = 0; shift < 64 && (used >> shift) != 0; shift += kDigitBits) {
        sort_by_digit(pairs, buffer, shift);
        pairs.swap(buffer);
    }
}

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
