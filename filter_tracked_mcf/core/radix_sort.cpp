#include "filter_tracked_mcf/core/radix_sort.h"

namespace tracked_mcf::radix {

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

void counts_to_places(std::vector<std::size_t>& counts, std::size_t digits) {
    std::size_t total = 0;
    for (std::size_t digit = 0; digit < digits; ++digit) {
        for (std::size_t i = digit; i < counts.size(); i += digits) {
            total += std::exchange(counts[i], total);
        }
    }
}

}  // namespace tracked_mcf::radix
