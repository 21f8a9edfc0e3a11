// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/element_partition.h"

#include <algorithm>

#include "filter_tracked_mcf/core/parallel/sorting.h"

namespace tracked_mcf {

ElementPartition::ElementPartition(const Level& level) : level_(level) {
    find_subsets();
    assign_slots();
}

void ElementPartition::find_subsets() {
    // Unknowns are numbered in the order in which elements first have them.
    std::int32_t unknown = 0;
    const std::int32_t count = level_.element_count();
    for (std::int32_t begin = 0; begin < count; begin += kSubsetSize) {
        Subset subset{begin, std::min(count, begin + kSubsetSize), unknown, unknown, 0, 0};
        for (std::int32_t element = subset.begin; element < subset.end; ++element) {
            for (const std::int32_t of_element : level_.unknowns[element]) {
                subset.unknown_end = std::max(subset.unknown_end, of_element + 1);
            }
        }
        unknown = subset.unknown_end;
        subsets_.push_back(subset);
    }
}

/// Gives each subset a slot for each unknown that it has but does not own, and sets the targets of
/// the blocks with such unknowns.
void ElementPartition::assign_slots() {
    constexpr std::int32_t none = -1;
    std::vector<KeyValue> slots;                                      // unknown and slot
    std::vector<std::int32_t> slot_of(level_.unknown_count(), none);  // latest slot of each unknown
    const auto target_of = [&](const Subset& subset, std::int32_t unknown) {
        if (unknown >= subset.unknown_begin) return unknown;
        std::int32_t& slot = slot_of[unknown];
        if (slot < subset.slot_begin) {
            slot = static_cast<std::int32_t>(slots.size());
            slots.push_back(
                {static_cast<std::uint64_t>(unknown), static_cast<std::uint64_t>(slot)});
        }
        return -1 - slot;
    };
    for (Subset& subset : subsets_) {
        subset.slot_begin = static_cast<std::int32_t>(slots.size());
        for (std::int32_t first = subset.begin; first < subset.end; first += kBlockElements) {
            const std::size_t offset = targets_.size();
            const std::int32_t end = std::min(subset.end, first + kBlockElements);
            for (std::int32_t element = first; element < end; ++element) {
                for (const std::int32_t unknown : level_.unknowns[element]) {
                    targets_.push_back(target_of(subset, unknown));
                }
            }
            const bool direct = std::all_of(targets_.begin() + offset, targets_.end(),
                                            [](std::int32_t target) { return target >= 0; });
            if (direct) targets_.resize(offset);
            target_offsets_.push_back(direct ? ElementRange::kDirect
                                             : static_cast<std::int64_t>(offset));
        }
        subset.slot_end = static_cast<std::int32_t>(slots.size());
    }
    slots_ = Field::Zero(4, static_cast<Eigen::Index>(slots.size()));
    std::stable_sort(slots.begin(), slots.end(),
                     [](const KeyValue& a, const KeyValue& b) { return a.key < b.key; });
    for (const KeyValue& slot : slots) {
        const auto unknown = static_cast<std::int32_t>(slot.key);
        const auto offset = static_cast<std::int64_t>(shared_slots_.size());
        if (shared_.empty() || shared_.back().unknown != unknown) {
            shared_.push_back({unknown, offset, offset});
        }
        ++shared_.back().end;
        shared_slots_.push_back(static_cast<std::int32_t>(slot.value));
    }
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

void ElementPartition::add_slots(Field& result) const {
    parallel_for_items(shared_, [&](const Shared& shared) {
        Eigen::Vector4f sum = result.col(shared.unknown);
        for (std::int64_t k = shared.begin; k < shared.end; ++k) {
            sum += slots_.col(shared_slots_[k]);
        }
        result.col(shared.unknown) = sum;
    });
}

ElementRange ElementPartition::range(const Subset& subset) const {
    return {level_.unknowns.front().data(),
            target_offsets_.data(),
            targets_.data(),
            slots_.data(),
            subset.begin,
            subset.end};
}

}  // namespace tracked_mcf
