#include "filter_tracked_mcf/core/locked_cells.h"

#include "filter_tracked_mcf/core/interruptible.h"

namespace tracked_mcf {

namespace {

/// The elements of the next coarser level that contain a marked element.
std::vector<std::uint8_t> mark_parents(const Level& fine, const Level& coarse,
                                       const std::vector<std::uint8_t>& marked) {
    std::vector<std::uint8_t> parents(static_cast<std::size_t>(coarse.element_count()), 0);
    serial_for(fine.element_count(), [&](std::int64_t element) {
        if (marked[element] != 0) parents[fine.parents[element]] = 1;
    });
    return parents;
}

/// The unknowns whose function's support contains a marked element.
std::vector<std::uint8_t> mark_unknowns(const Level& level,
                                        const std::vector<std::uint8_t>& marked) {
    std::vector<std::uint8_t> unknowns(static_cast<std::size_t>(level.unknown_count()), 0);
    serial_for(level.element_count(), [&](std::int64_t element) {
        if (marked[element] == 0) return;
        for (const std::int32_t unknown : level.unknowns[element]) unknowns[unknown] = 1;
    });
    return unknowns;
}

}  // namespace

std::vector<std::vector<std::uint8_t>> unknowns_meeting_held_edges(
    const TrackedElements& elements) {
    std::vector<std::vector<std::uint8_t>> locked(elements.levels.size());
    std::vector<std::uint8_t> marked = elements.held;
    for (std::size_t l = elements.levels.size(); l-- > 0;) {
        locked[l] = mark_unknowns(elements.levels[l], marked);
        if (l > 0) marked = mark_parents(elements.levels[l], elements.levels[l - 1], marked);
    }
    return locked;
}

std::vector<std::vector<std::uint8_t>> no_unknowns(const TrackedElements& elements) {
    std::vector<std::vector<std::uint8_t>> none;
    for (const Level& level : elements.levels) {
        none.emplace_back(static_cast<std::size_t>(level.unknown_count()), std::uint8_t{0});
    }
    return none;
}

}  // namespace tracked_mcf
