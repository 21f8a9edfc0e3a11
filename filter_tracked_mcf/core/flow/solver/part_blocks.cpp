// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/part_blocks.h"

namespace tracked_mcf {

PartBlocks::PartBlocks(const std::vector<std::int32_t>& parts) {
    constexpr auto most = static_cast<std::int32_t>(kChunkSize);
    const auto rows = static_cast<std::int32_t>(parts.size());
    std::int32_t rows_of_chunk = most;  // the first block begins a chunk
    for (std::int32_t row = 0; row < rows;) {
        const std::int32_t part = parts[row], begin = row;
        if (row == 0 || parts[row - 1] != part) first_of_part_.push_back(count());
        while (row < rows && row - begin < most && parts[row] == part) ++row;
        if (rows_of_chunk + (row - begin) > most) {
            first_of_chunk_.push_back(count());
            rows_of_chunk = 0;
        }
        rows_of_chunk += row - begin;
        blocks_.push_back(
            {begin, row, part, static_cast<std::int32_t>(first_of_chunk_.size()) - 1});
    }
    first_of_part_.push_back(count());
    first_of_chunk_.push_back(count());
}

}  // namespace tracked_mcf
