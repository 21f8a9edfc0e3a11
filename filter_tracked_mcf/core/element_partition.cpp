#include "filter_tracked_mcf/core/element_partition.h"

#include <algorithm>

#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/sorting.h"

namespace tracked_mcf {

ElementPartition::ElementPartition(const Level& level) : level_(level) {
    find_parts();
    send_elsewhere();
}

void ElementPartition::find_parts() {
    // Unknowns are numbered as the elements have them first.
    std::int32_t unknown = 0;
    const std::int32_t count = level_.element_count();
    for (std::int32_t begin = 0; begin < count; begin += kPartSize) {
        Part part{begin, std::min(count, begin + kPartSize), unknown, unknown, 0, 0};
        serial_for(part.begin, part.end, [&](std::int64_t element) {
            for (const std::int32_t of_element : level_.unknowns[element]) {
                part.unknown_end = std::max(part.unknown_end, of_element + 1);
            }
        });
        unknown = part.unknown_end;
        parts_.push_back(part);
    }
}

/// Whether the block of elements that begins here has no unknowns of earlier parts.
bool ElementPartition::owns_all(const Part& part, std::int32_t first) const {
    const std::int32_t end = std::min(part.end, first + kBlockElements);
    return std::all_of(
        level_.unknowns.begin() + first, level_.unknowns.begin() + end, [&](const auto& unknowns) {
            return *std::min_element(unknowns.begin(), unknowns.end()) >= part.unknown_begin;
        });
}

/// Finds the blocks that have unknowns of earlier parts, and gives these slots.
void ElementPartition::send_elsewhere() {
    constexpr std::int32_t none = -1;
    std::vector<KeyValue> slots;  // an unknown, and a slot of it
    std::vector<std::int32_t> slot_of(static_cast<std::size_t>(level_.unknown_count()), none);
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
        serial_for(part.begin, part.end, [&](std::int64_t element) {
            const auto i = static_cast<std::int32_t>(element);
            if (i % kBlockElements == 0) {
                detours_.push_back(owns_all(part, i) ? ElementRange::kStraight
                                                     : static_cast<std::int64_t>(targets_.size()));
            }
            if (detours_.back() == ElementRange::kStraight) return;
            for (const std::int32_t unknown : level_.unknowns[i]) {
                targets_.push_back(target_of(part, unknown));
            }
        });
        part.slot_end = static_cast<std::int32_t>(slots.size());
    }
    slots_ = Field::Zero(4, static_cast<Eigen::Index>(slots.size()));
    std::stable_sort(slots.begin(), slots.end(),
                     [](const KeyValue& a, const KeyValue& b) { return a.key < b.key; });
    for (std::size_t i = 0; i < slots.size(); ++i) {
        const auto unknown = static_cast<std::int32_t>(slots[i].key);
        const auto place = static_cast<std::int64_t>(i);
        if (shared_.empty() || shared_.back().unknown != unknown) {
            shared_.push_back({unknown, place, place});
        }
        ++shared_.back().end;
        shared_slots_.push_back(static_cast<std::int32_t>(slots[i].value));
    }
}

void ElementPartition::open(const Part& part, const Field* base, Field& result) const {
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
    parallel_for_rows(static_cast<std::int64_t>(shared_.size()), [&](std::int32_t i) {
        const Shared& shared = shared_[i];
        Eigen::Vector4f sum = result.col(shared.unknown);
        for (std::int64_t k = shared.begin; k < shared.end; ++k)
            sum += slots_.col(shared_slots_[k]);
        result.col(shared.unknown) = sum;
    });
}

ElementRange ElementPartition::range(const Part& part) const {
    return {level_.unknowns.front().data(),
            detours_.data(),
            targets_.data(),
            slots_.data(),
            part.begin,
            part.end};
}

}  // namespace tracked_mcf
