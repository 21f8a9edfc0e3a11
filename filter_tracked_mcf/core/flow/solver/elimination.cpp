// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/elimination.h"

#include <algorithm>

#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// A block of a stage is 2 to this power blocks of the stage before.
constexpr int kBitsOfStage = 5;

}  // namespace

Elimination::Elimination(const Stars& stars, const PartBlocks& blocks)
    : stages_(static_cast<std::size_t>(stars.count())), order_(stages_.size()) {
    find_stages(stars, blocks);
    const auto count_inside = [&](std::int64_t block) {
        return std::count(stages_.begin() + blocks[static_cast<std::int32_t>(block)].begin,
                          stages_.begin() + blocks[static_cast<std::int32_t>(block)].end, 0);
    };
    parallel_prefix_sum(blocks.count(), count_inside, begins_);
    blocks.for_each([&](std::int32_t block) {
        std::int32_t* next = order_.data() + begins_[block];
        for (std::int32_t row = blocks[block].begin; row < blocks[block].end; ++row) {
            if (stages_[row] == 0) *next++ = row;
        }
    });
    const std::int32_t* const end = order_.data() + order_.size();
    for (std::int32_t* next = order_.data() + begins_.back(); next != end;)
        next = append_stage(blocks, next);
}

void Elimination::find_stages(const Stars& stars, const PartBlocks& blocks) {
    blocks.for_each([&](std::int32_t block) {
        const std::int32_t first = blocks.of_part(blocks[block].part).first;
        for (std::int32_t row = blocks[block].begin; row < blocks[block].end; ++row) {
            for_each_neighbour(stars, row, [&](std::int32_t neighbour) {
                if (neighbour >= blocks[block].begin) return;
                const auto block_of_neighbour =
                    static_cast<std::int32_t>((neighbour - blocks[first].begin) / kChunkSize);
                std::uint8_t stage = 0;
                while (((block - first) >> (kBitsOfStage * stage)) !=
                       (block_of_neighbour >> (kBitsOfStage * stage))) {
                    ++stage;
                }
                stages_[row] = std::max(stages_[row], stage);
            });
        }
    });
}

std::int32_t* Elimination::append_stage(const PartBlocks& blocks, std::int32_t* next) {
    std::vector<Separator>& separators = later_stages_.emplace_back();
    const auto stage = static_cast<int>(later_stages_.size());
    const auto rows = parallel_collect_if<std::int32_t>(
        static_cast<std::int64_t>(stages_.size()),
        [&](std::int64_t row) { return stages_[row] == stage; },
        [](std::int64_t row) { return static_cast<std::int32_t>(row); });
    std::int32_t block = 0, block_of_stage = -1;
    for (const std::int32_t row : rows) {
        while (row >= blocks[block].end) ++block;
        const std::int32_t part = blocks[block].part;
        const std::int32_t here = (block - blocks.of_part(part).first) >> (kBitsOfStage * stage);
        if (separators.empty() || separators.back().part != part || here != block_of_stage)
            separators.push_back({part, {next, next}});
        block_of_stage = here;
        *next++ = row;
        separators.back().rows.last = next;
    }
    return next;
}

}  // namespace tracked_mcf
