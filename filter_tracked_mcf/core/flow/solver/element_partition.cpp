// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/element_partition.h"

#include <algorithm>

#include "filter_tracked_mcf/core/parallel/sorting.h"

namespace tracked_mcf {

ElementPartition::ElementPartition(const Level& level) : level_(level) {
    find_parts();
    assign_slots();
}

void ElementPartition::find_parts() {
    // Unknowns are numbered in the order in which elements first have them.
    std::int32_t unknown = 0;
    const std::int32_t count = level_.element_count();
    for (std::int32_t begin = 0; begin < count; begin += kPartSize) {
        Part part{begin, std::min(count, begin + kPartSize), unknown, unknown, 0, 0};
        for (std::int32_t element = part.begin; element < part.end; ++element) {
            for (const std::int32_t of_element : level_.unknowns[element]) {
                part.unknown_end = std::max(part.unknown_end, of_element + 1);
            }
        }
        unknown = part.unknown_end;
        parts_.push_back(part);
    }
}

/// Gives each part a slot for each unknown that it has but does not own, and sets the targets of
/// the blocks with such unknowns.
void ElementPartition::assign_slots() {
    constexpr std::int32_t none = -1;
    std::vector<KeyValue> slots;                                      // unknown and slot
    std::vector<std::int32_t> slot_of(level_.unknown_count(), none);  // latest slot of each unknown
    const auto target_of = [&](const Part& part, std::int32_t unknown) {
        if (unknown >= part.unknown_begin) return unknown;
        std::int32_t& slot = slot_of[unknown];
        if (slot < part.slot_begin) {
            slot = static_cast<std::int32_t>(slots.size());
            slots.push_back(
                {static_cast<std::uint64_t>(unknown), static_cast<std::uint64_t>(slot)});
        }
        return -1 - slot;
    };
    for (Part& part : parts_) {
        part.slot_begin = static_cast<std::int32_t>(slots.size());
        for (std::int32_t first = part.begin; first < part.end; first += kBlockElements) {
            const std::size_t offset = targets_.size();
            const std::int32_t end = std::min(part.end, first + kBlockElements);
            for (std::int32_t element = first; element < end; ++element) {
                for (const std::int32_t unknown : level_.unknowns[element]) {
                    targets_.push_back(target_of(part, unknown));
                }
            }
            const bool direct = std::all_of(targets_.begin() + offset, targets_.end(),
                                            [](std::int32_t target) { return target >= 0; });
            if (direct) targets_.resize(offset);
            target_offsets_.push_back(direct ? ElementRange::kDirect
                                             : static_cast<std::int64_t>(offset));
        }
        part.slot_end = static_cast<std::int32_t>(slots.size());
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

/// Sets the part's slots to zero and its own unknowns to the base.
void ElementPartition::initialize(const Part& part, const Field* base, Field& result) const {
    slots_.middleCols(part.slot_begin, part.slot_end - part.slot_begin).setZero();
    if (base == &result) return;
    const std::int32_t count = part.unknown_end - part.unknown_begin;
    if (base != nullptr) {
        result.middleCols(part.unknown_begin, count) = base->middleCols(part.unknown_begin, count);
    } else {
        result.middleCols(part.unknown_begin, count).setZero();
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

ElementRange ElementPartition::range(const Part& part) const {
    return {level_.unknowns.front().data(),
            target_offsets_.data(),
            targets_.data(),
            slots_.data(),
            part.begin,
            part.end};
}

}  // namespace tracked_mcf
