// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/parallel/sorting.h"

namespace tracked_mcf {

namespace radix {

std::vector<Digit> digits_of(std::uint64_t varying) {
    constexpr unsigned key_bits = 64;
    unsigned begin = 0;
    unsigned end = key_bits;
    while (begin < end && (varying >> begin & 1U) == 0) ++begin;
    while (begin < end && (varying >> (end - 1) & 1U) == 0) --end;
    std::vector<Digit> digits;
    for (unsigned left = (end - begin + kMostBits - 1) / kMostBits; left > 0; --left) {
        const unsigned bits = (end - begin + left - 1) / left;
        digits.push_back({begin, bits});
        begin += bits;
    }
    return digits;
}

void counts_to_offsets(std::vector<std::size_t>& counts, std::size_t digits) {
    std::size_t total = 0;
    for (std::size_t digit = 0; digit < digits; ++digit) {
        for (std::size_t i = digit; i < counts.size(); i += digits) {
            total += std::exchange(counts[i], total);
        }
    }
}

}  // namespace radix

// A counting sort.
Groups::Groups(const std::vector<std::int32_t>& group_of, std::int32_t group_count)
    : begin_(static_cast<std::size_t>(group_count) + 1, 0), items_(group_of.size()) {
    for (const std::int32_t group : group_of) ++begin_[group + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<std::int64_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t item = 0; item < group_of.size(); ++item) {
        items_[next[group_of[item]]++] = static_cast<std::int32_t>(item);
    }
}

}  // namespace tracked_mcf
