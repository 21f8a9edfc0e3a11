// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/system/constrained_cells.h"

#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// Marks the elements of the next coarser level that contain a marked element.
std::vector<std::uint8_t> mark_parents(const Level& fine, const Level& coarse,
                                       const std::vector<std::uint8_t>& marked) {
    std::vector<std::uint8_t> parents(static_cast<std::size_t>(coarse.element_count()), 0);
    for (std::int32_t element = 0; element < fine.element_count(); ++element) {
        if (marked[element] != 0) parents[fine.parents[element]] = 1;
    }
    return parents;
}

/// Marks the unknowns whose function's support contains a marked element.
std::vector<std::uint8_t> mark_unknowns(const Level& level,
                                        const std::vector<std::uint8_t>& marked) {
    std::vector<std::uint8_t> unknowns(static_cast<std::size_t>(level.unknown_count()), 0);
    for (std::int32_t element = 0; element < level.element_count(); ++element) {
        if (marked[element] == 0) continue;
        for (const std::int32_t unknown : level.unknowns[element]) unknowns[unknown] = 1;
    }
    return unknowns;
}

}  // namespace

std::vector<std::vector<std::uint8_t>> constrained_unknowns(const TrackedElements& elements,
                                                            BoundaryCondition boundary) {
    std::vector<std::vector<std::uint8_t>> constrained(elements.levels.size());
    std::vector<std::uint8_t> marked = elements.meets_constrained_edge;
    if (boundary != BoundaryCondition::LockedCells) marked.assign(marked.size(), 0);
    for (std::size_t l = elements.levels.size(); l-- > 0;) {
        constrained[l] = mark_unknowns(elements.levels[l], marked);
        if (l > 0) marked = mark_parents(elements.levels[l], elements.levels[l - 1], marked);
    }
    return constrained;
}

void eliminate_constrained(const Level& level, const std::vector<std::uint8_t>& constrained,
                           MatrixBlocks& matrices) {
    parallel_for_rows(level.element_count(), [&](std::int32_t element) {
        for (int corner = 0; corner < 8; ++corner) {
            if (constrained[level.unknowns[element][corner]] == 0) continue;
            for (int i = 0; i < 8; ++i) matrices.at(element, corner, i) = 0;
        }
    });
}

}  // namespace tracked_mcf
