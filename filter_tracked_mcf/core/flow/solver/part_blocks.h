// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

/// The rows of a system, part by part, cut into blocks.
///
/// The blocks of a part depend on its number of rows alone, so what is computed block by block is
/// the same whichever other parts there are. Threads take chunks of blocks: many parts of a few
/// rows cost what their rows cost.
class PartBlocks {
public:
    /// Rows of one part: at most kChunkSize.
    struct Block {
        std::int32_t begin, end;
        std::int32_t part;
        std::int32_t chunk;
    };

    /// `parts` has the part of each row, from 0 on, without gaps, and never decreasing.
    explicit PartBlocks(const std::vector<std::int32_t>& parts);

    std::int32_t part_count() const { return static_cast<std::int32_t>(first_of_part_.size()) - 1; }
    std::int32_t count() const { return static_cast<std::int32_t>(blocks_.size()); }
    std::int32_t chunk_count() const {
        return static_cast<std::int32_t>(first_of_chunk_.size()) - 1;
    }
    const Block& operator[](std::int32_t block) const { return blocks_[block]; }

    /// The blocks from `first` to `last` - 1.
    struct Range {
        std::int32_t first, last;
    };
    Range of_part(std::int32_t part) const {
        return {first_of_part_[part], first_of_part_[part + 1]};
    }
    Range of_chunk(std::int32_t chunk) const {
        return {first_of_chunk_[chunk], first_of_chunk_[chunk + 1]};
    }

    /// Calls body(block's number) for all blocks, in parallel.
    template <class Body>
    void for_each(const Body& body) const {
        parallel_for(chunk_count(), [&](std::int64_t chunk) {
            const auto [first, last] = of_chunk(static_cast<std::int32_t>(chunk));
            for (std::int32_t block = first; block < last; ++block) body(block);
        });
    }

private:
    std::vector<Block> blocks_;
    std::vector<std::int32_t> first_of_part_, first_of_chunk_;  ///< and the end
};

}  // namespace tracked_mcf
