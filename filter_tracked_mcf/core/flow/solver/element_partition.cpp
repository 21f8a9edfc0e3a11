// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/element_partition.h"

namespace tracked_mcf {

ElementPartition::ElementPartition(const Level& level) : level_(level) {
    // Unknowns are numbered in the order in which elements first have them.
    std::vector<std::int32_t>& slots = unknown_of_slot_;
    const auto slot_count = [&] { return static_cast<std::int64_t>(slots.size()); };
    std::int32_t owned = 0;
    for (std::int32_t begin = 0; begin < level.element_count(); begin += kSubsetSize) {
        const std::int32_t end = std::min(level.element_count(), begin + kSubsetSize);
        Subset subset{begin, end, owned, owned, slot_count(), 0};
        for (std::int32_t element = begin; element < end; ++element) {
            for (const std::int32_t unknown : level.unknowns[element]) {
                owned = std::max(owned, unknown + 1);
                if (unknown < subset.unknown_begin) slots.push_back(unknown);
            }
        }
        std::sort(slots.begin() + subset.slot_begin, slots.end());
        slots.erase(std::unique(slots.begin() + subset.slot_begin, slots.end()), slots.end());
        subset.unknown_end = owned;
        subset.slot_end = slot_count();
        subsets_.push_back(subset);
    }
    slots_ = Field::Zero(4, slot_count());
}

/// Sets the subset's slots to zero and its own unknowns to the base.
void ElementPartition::initialize(const Subset& subset, const Field* base, Field& result) const {
    slots_.middleCols(subset.slot_begin, subset.slot_end - subset.slot_begin).setZero();
    if (base == &result) return;
    const std::int32_t count = subset.unknown_end - subset.unknown_begin;
    if (base != nullptr) {
        result.middleCols(subset.unknown_begin, count) =
            base->middleCols(subset.unknown_begin, count);
    } else {
        result.middleCols(subset.unknown_begin, count).setZero();
    }
}

void ElementPartition::add_products(const MatrixBlocks& matrices, float factor, const Field& x,
                                    const Field* base, Field& result) const {
    sum(base, result, [&](std::int32_t element, const auto& at) {
        const auto& unknowns = level_.unknowns[element];
        Eigen::Vector4f values[8], sums[8];
        for (int i = 0; i < 8; ++i) {
            values[i] = x.col(unknowns[i]);
            sums[i].setZero();
        }
        const float* entry = matrices[element].entry;
        for (int i = 0; i < 8; ++i) {
            sums[i] += *entry++ * values[i];
            for (int j = i + 1; j < 8; ++j, ++entry) {
                sums[i] += *entry * values[j];
                sums[j] += *entry * values[i];
            }
        }
        for (int i = 0; i < 8; ++i) at(unknowns[i]) += factor * sums[i];
    });
}

}  // namespace tracked_mcf
