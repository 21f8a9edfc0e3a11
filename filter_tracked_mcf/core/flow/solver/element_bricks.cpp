// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/element_bricks.h"

namespace tracked_mcf {

namespace {

/// A brick has 2^4 cells a side: a few hundred elements, few of them at its surface.
constexpr unsigned kBrickBits = 4 * 3;

}  // namespace

ElementBricks::ElementBricks(const Level& level) {
    std::array<std::vector<Brick>, 8> colours;
    const auto brick_of = [&](std::int32_t element) { return level.cells[element] >> kBrickBits; };
    const std::int32_t count = level.element_count();
    for (std::int32_t begin = 0, end = 0; begin < count; begin = end) {
        while (end < count && brick_of(end) == brick_of(begin)) ++end;
        colours[octant_of(brick_of(begin))].push_back({begin, end});
    }
    colour_begin_[0] = 0;
    for (std::size_t colour = 0; colour < 8; ++colour) {
        bricks_.insert(bricks_.end(), colours[colour].begin(), colours[colour].end());
        colour_begin_[colour + 1] = bricks_.size();
    }
}

}  // namespace tracked_mcf
