// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/solver/element_blocks.h"

namespace tracked_mcf {

namespace {

/// A block has 2^4 cells a side: a few hundred elements, few of them at its surface.
constexpr unsigned kBlockBits = 4 * 3;

}  // namespace

ElementBlocks::ElementBlocks(const Level& level) {
    std::array<std::vector<Block>, 8> colours;
    const auto block_of = [&](std::int32_t element) { return level.cells[element] >> kBlockBits; };
    const std::int32_t count = level.element_count();
    for (std::int32_t begin = 0, end = 0; begin < count; begin = end) {
        while (end < count && block_of(end) == block_of(begin)) ++end;
        colours[octant_of(block_of(begin))].push_back({begin, end});
    }
    colour_begin_[0] = 0;
    for (std::size_t colour = 0; colour < 8; ++colour) {
        blocks_.insert(blocks_.end(), colours[colour].begin(), colours[colour].end());
        colour_begin_[colour + 1] = blocks_.size();
    }
}

}  // namespace tracked_mcf
