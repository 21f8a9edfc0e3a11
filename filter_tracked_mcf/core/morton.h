#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/clip.h"

namespace tracked_mcf {

/// A cell's place along the octree's depth-first order: the bits of its coordinates interleaved, x
/// lowest. The parent's code is the child's without its last three bits, which are the octant.
using MortonCode = std::uint64_t;

/// Spreads the low 21 bits of a number out to every third bit.
inline std::uint64_t spread_bits(std::uint64_t value) {
    value &= 0x1fffffU;
    value = (value | value << 32U) & 0x1f00000000ffffU;
    value = (value | value << 16U) & 0x1f0000ff0000ffU;
    value = (value | value << 8U) & 0x100f00f00f00f00fU;
    value = (value | value << 4U) & 0x10c30c30c30c30c3U;
    value = (value | value << 2U) & 0x1249249249249249U;
    return value;
}

/// The inverse of spread_bits.
inline std::uint64_t gather_bits(std::uint64_t value) {
    value &= 0x1249249249249249U;
    value = (value | value >> 2U) & 0x10c30c30c30c30c3U;
    value = (value | value >> 4U) & 0x100f00f00f00f00fU;
    value = (value | value >> 8U) & 0x1f0000ff0000ffU;
    value = (value | value >> 16U) & 0x1f00000000ffffU;
    value = (value | value >> 32U) & 0x1fffffU;
    return value;
}

inline MortonCode morton_code(const Cell& cell) {
    return spread_bits(static_cast<std::uint64_t>(cell[0])) |
           spread_bits(static_cast<std::uint64_t>(cell[1])) << 1U |
           spread_bits(static_cast<std::uint64_t>(cell[2])) << 2U;
}

inline Cell cell_at(MortonCode code) {
    return {static_cast<std::int32_t>(gather_bits(code)),
            static_cast<std::int32_t>(gather_bits(code >> 1U)),
            static_cast<std::int32_t>(gather_bits(code >> 2U))};
}

inline MortonCode parent_of(MortonCode code) {
    return code >> 3U;
}
inline int octant_of(MortonCode code) {
    return static_cast<int>(code & 7U);
}

}  // namespace tracked_mcf
