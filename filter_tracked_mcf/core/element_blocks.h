#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/octree.h"
#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

/// A level's elements, cut into blocks of cells that have eight colours: blocks of one colour do
/// not touch, so they have no unknown in common and can add to the unknowns in parallel. The order
/// in which an unknown is added to is that of the colours, and of the elements inside a block: it
/// does not depend on the number of threads, so the bits do not either.
class ElementBlocks {
public:
    explicit ElementBlocks(const Level& level);

    /// Calls body(begin, end) for the elements of every block, colour by colour.
    template <class Body>
    void for_each(const Body& body) const {
        for_each_numbered([&](std::size_t, const Block& block) { body(block.begin, block.end); });
    }

    /// The sum of body(begin, end), doubles, over all blocks, which are gone through in the same
    /// way.
    template <class Body>
    double sum(const Body& body) const {
        std::vector<double> sums(blocks_.size());
        for_each_numbered([&](std::size_t number, const Block& block) {
            sums[number] = body(block.begin, block.end);
        });
        return std::accumulate(sums.begin(), sums.end(), 0.0);
    }

private:
    struct Block {
        std::int32_t begin, end;  ///< elements
    };

    /// Blocks of one colour that outweigh waking and joining threads.
    static constexpr std::int64_t kWorthThreads = 8;

    template <class Body>
    void for_each_numbered(const Body& body) const {
        for (std::size_t colour = 0; colour < 8; ++colour) {
            const std::size_t first = colour_begin_[colour];
            parallel_for(
                static_cast<std::int64_t>(colour_begin_[colour + 1] - first),
                [&](std::int64_t i) {
                    const std::size_t number = first + static_cast<std::size_t>(i);
                    body(number, blocks_[number]);
                },
                kWorthThreads);
        }
    }

    std::vector<Block> blocks_;                ///< sorted by colour
    std::array<std::size_t, 9> colour_begin_;  ///< of every colour, and the end
};

}  // namespace tracked_mcf
