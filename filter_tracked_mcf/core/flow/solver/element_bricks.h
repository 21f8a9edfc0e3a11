// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow/octree/octree.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

/// A level's elements, grouped into bricks, cubes of cells, in eight colours. Bricks of one colour
/// do not touch, so they share no unknown, and threads can add to their unknowns at the same time.
/// The contributions to an unknown are added colour by colour, and within a brick in the order of
/// the elements. This order does not depend on the number of threads, so neither do the bits.
class ElementBricks {
public:
    explicit ElementBricks(const Level& level);

    /// Calls body(begin, end) for the elements of each brick, colour by colour.
    template <class Body>
    void for_each(const Body& body) const {
        for (std::size_t colour = 0; colour < 8; ++colour) {
            const Brick* const bricks = bricks_.data() + colour_begin_[colour];
            parallel_for(
                static_cast<std::int64_t>(colour_begin_[colour + 1] - colour_begin_[colour]),
                [&](std::int64_t i) { body(bricks[i].begin, bricks[i].end); }, kWorthThreads);
        }
    }

private:
    struct Brick {
        std::int32_t begin, end;  ///< elements
    };

    /// With this many bricks of one colour or more, threads save more time than they cost.
    static constexpr std::int64_t kWorthThreads = 8;

    std::vector<Brick> bricks_;                ///< sorted by colour
    std::array<std::size_t, 9> colour_begin_;  ///< offset of each colour, and the end
};

}  // namespace tracked_mcf
