// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow/solver/part_blocks.h"
#include "filter_tracked_mcf/core/mesh/stars.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"

namespace tracked_mcf {

/// The order in which an incomplete factorisation eliminates the rows of a system, such that
/// threads share its work, no entry is left out, and it is the same for any number of threads: a
/// nested dissection (George, "Nested Dissection of a Regular Finite Element Mesh", 1973).
///
/// Stage 0 eliminates those rows of each block that have no neighbour in an earlier block. The
/// other ones, a tenth of them on a surface, are left to stage 1, whose blocks are 32 as one, and
/// so on, until a part is one block. So no two blocks of a stage have neighbours in it. Within a
/// block, rows are eliminated in increasing order. The order follows from a part's rows alone.
class Elimination {
public:
    /// Rows whose elimination is one thread's, in order.
    struct Rows {
        const std::int32_t* first;
        const std::int32_t* last;  ///< behind them
        const std::int32_t* begin() const { return first; }
        const std::int32_t* end() const { return last; }
    };
    /// Rows of stage 1 or later.
    struct Separator {
        std::int32_t part;
        Rows rows;
    };

    /// Takes the neighbours of each row, which must be of its part.
    Elimination(const Stars& stars, const PartBlocks& blocks);
    Elimination(const Elimination&) = delete;
    Elimination& operator=(const Elimination&) = delete;

    /// Returns the rows of a block of PartBlocks that stage 0 eliminates.
    Rows inside(std::int32_t block) const {
        return {order_.data() + begins_[block], order_.data() + begins_[block + 1]};
    }
    /// The separators of each later stage, in the order of their parts.
    const std::vector<std::vector<Separator>>& later_stages() const { return later_stages_; }

    /// Returns whether stage 0 eliminates a row. Then it does so with all neighbours that are
    /// eliminated before it.
    bool is_inside(std::int32_t row) const { return stages_[row] == 0; }
    /// Returns whether a row comes before another one in the order of their part.
    bool precedes(std::int32_t row, std::int32_t other) const {
        return stages_[row] != stages_[other] ? stages_[row] < stages_[other] : row < other;
    }

private:
    void find_stages(const Stars& stars, const PartBlocks& blocks);
    /// Appends the next stage to the order, at `next`. Returns the end of it.
    std::int32_t* append_stage(const PartBlocks& blocks, std::int32_t* next);

    std::vector<std::uint8_t> stages_;   ///< per row
    RawVector<std::int32_t> order_;      ///< the rows
    std::vector<std::uint32_t> begins_;  ///< per block: in order_, and the end
    std::vector<std::vector<Separator>> later_stages_;
};

}  // namespace tracked_mcf
