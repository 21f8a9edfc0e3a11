// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/octree/octree.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/flow/cells/bspline.h"
#include "filter_tracked_mcf/core/parallel/disjoint_sets.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/sorting.h"

namespace tracked_mcf {

namespace {

// A *corner index* is 8 * element + corner.

void check_size(const Level& level) {
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max() / 8;
    if (level.cells.size() > most) {
        throw InvalidParameter("The octree would have more than " + std::to_string(most) +
                               " cells; choose a smaller depth.");
    }
}

/// Numbers classes of items in the order of their first members. `first(i)` is the smallest item in
/// the class of item i. Sets number(i) to the number of that class. Returns the number of classes.
template <class First, class Number>
std::int32_t number_classes(std::int64_t count, const First& first, const Number& number) {
    const auto is_first = [&](std::int64_t i) { return first(static_cast<std::int32_t>(i)) == i; };
    const std::int64_t class_count = parallel_scan<std::int64_t>(
        count, is_first, [&](std::int64_t begin, std::int64_t end, std::int64_t next) {
            for (std::int64_t i = begin; i < end; ++i) {
                if (is_first(i)) number(i) = static_cast<std::int32_t>(next++);
            }
        });
    parallel_for_rows(count, [&](std::int32_t i) {
        const std::int32_t first_of_class = first(i);
        if (first_of_class != i) number(i) = number(first_of_class);
    });
    return static_cast<std::int32_t>(class_count);
}

/// Gives corner indices with the same first(corner index) the same unknown.
template <class First>
void number_classes_of_corners(Level& level, const First& first) {
    level.unknowns.resize(level.cells.size());
    level.number_of_unknowns = number_classes(
        8 * std::int64_t{level.element_count()},
        first, [&](std::int64_t index) -> auto& { return level.unknowns[index / 8][index % 8]; });
    std::vector<std::int32_t> unknowns;
    unknowns.reserve(8 * level.unknowns.size());
    for (const auto& of_element : level.unknowns)
        unknowns.insert(unknowns.end(), of_element.begin(), of_element.end());
    level.corners = Groups(unknowns, level.number_of_unknowns);
}

/// Gives each distinct corner of the occupied cells one unknown.
void number_unknowns(Level& level) {
    check_size(level);
    RawVector<KeyValue> corners(8 * level.cells.size());  // values are corner indices
    parallel_for_rows(level.element_count(), [&](std::int32_t element) {
        const Cell cell = cell_at(level.cells[element]);
        for (int corner = 0; corner < 8; ++corner) {
            const auto index = static_cast<std::uint64_t>(8 * std::int64_t{element} + corner);
            corners[index] = {morton_code(corner_of(cell, corner)), index};
        }
    });
    sort_by_key(corners);
    const auto count = static_cast<std::int64_t>(corners.size());
    RawVector<std::int32_t> first(corners.size());
    const auto begins = runs_by(corners, [](const KeyValue& corner) { return corner.key; });
    parallel_for_runs(count, begins, [&](std::int64_t begin, std::int64_t end) {
        std::int64_t run = begin;
        for (std::int64_t i = begin; i < end; ++i) {
            if (begins(i)) run = i;
            first[corners[i].value] = static_cast<std::int32_t>(corners[run].value);
        }
    });
    number_classes_of_corners(level, [&](std::int32_t index) { return first[index]; });
}

/// Unites the corner indices of two linked elements at all corners that their cells share.
void unite_shared_corners(const Link& link, const Level& level, DisjointSets& corners) {
    const Cell offset = cell_at(level.cells[link.second]) - cell_at(level.cells[link.first]);
    // Along an axis with an offset, shared corners have a fixed bit in either cell. Along an axis
    // without one, their bit is the same in both cells, and 0 or 1.
    int in_first = 0;
    int in_second = 0;
    int free = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const int bit = 1 << axis;
        if (offset[axis] > 0) in_first |= bit;
        if (offset[axis] < 0) in_second |= bit;
        if (offset[axis] == 0) free |= bit;
    }
    for (int chosen = free;; chosen = (chosen - 1) & free) {  // all subsets of the free bits
        corners.unite(8 * link.first + (in_first | chosen), 8 * link.second + (in_second | chosen));
        if (chosen == 0) break;
    }
}

/// Gives each set of corners that links unite one unknown.
void number_unknowns(Level& level, const RawVector<Link>& links) {
    check_size(level);
    DisjointSets corners(8 * level.element_count());
    parallel_for_items(links,
                       [&](const Link& link) { unite_shared_corners(link, level, corners); });
    number_classes_of_corners(level, [&](std::int32_t index) { return corners.find(index); });
}

/// Makes the elements of the next coarser level from classes of elements in one parent cell.
/// first(element) is the smallest element of a class. Sets the fine elements' parents and returns
/// the cells of the coarse elements.
template <class First>
std::vector<MortonCode> make_parents(Level& fine, const First& first) {
    fine.parents.resize(fine.cells.size());
    const std::int32_t parent_count = number_classes(
        fine.element_count(),
        first, [&](std::int64_t element) -> auto& { return fine.parents[element]; });
    std::vector<MortonCode> coarse_cells(static_cast<std::size_t>(parent_count));
    parallel_for_rows(fine.element_count(), [&](std::int32_t element) {
        if (first(element) == element)
            coarse_cells[fine.parents[element]] = parent_of(fine.cells[element]);
    });
    return coarse_cells;
}

/// Unites linked elements with the same parent cell.
std::vector<MortonCode> coarsen_elements(Level& fine, const RawVector<Link>& links) {
    DisjointSets siblings(fine.element_count());
    parallel_for_items(links, [&](const Link& link) {
        if (parent_of(fine.cells[link.first]) == parent_of(fine.cells[link.second])) {
            siblings.unite(link.first, link.second);
        }
    });
    return make_parents(fine, [&](std::int32_t element) { return siblings.find(element); });
}

/// Unites all elements with the same parent cell.
std::vector<MortonCode> coarsen_elements(Level& fine) {
    return make_parents(fine, [&](std::int32_t element) {
        const MortonCode parent = parent_of(fine.cells[element]);
        while (element > 0 && parent_of(fine.cells[element - 1]) == parent) --element;
        return element;
    });
}

/// Returns the links between the elements of the next coarser level.
RawVector<Link> coarsen_links(const RawVector<Link>& links,
                              const std::vector<std::int32_t>& parents,
                              std::int32_t coarse_element_count) {
    auto coarse = parallel_collect_if<Link, RawVector<Link>>(
        static_cast<std::int64_t>(links.size()),
        [&](std::int64_t i) { return parents[links[i].first] != parents[links[i].second]; },
        [&](std::int64_t i) {
            const auto [first, second] =
                std::minmax({parents[links[i].first], parents[links[i].second]});
            return Link{first, second};
        });
    sort_and_remove_copies(coarse, coarse_element_count);
    return coarse;
}

std::vector<Level> empty_levels(std::vector<MortonCode> finest_cells, int depth) {
    std::vector<Level> levels(static_cast<std::size_t>(depth) + 1);
    for (int l = 0; l <= depth; ++l) levels[l].depth = l;
    levels[depth].cells = std::move(finest_cells);
    return levels;
}

}  // namespace

void sort_and_remove_copies(RawVector<Link>& links, std::int32_t element_count) {
    unsigned element_bits = 0;
    while ((element_count >> element_bits) != 0) ++element_bits;
    const auto key = [=](const Link& link) {
        return static_cast<std::uint64_t>(link.first) << element_bits |
               static_cast<std::uint64_t>(link.second);
    };
    sort_by(links, key);
    links = parallel_collect_if<Link, RawVector<Link>>(static_cast<std::int64_t>(links.size()),
                                                       runs_by(links, key),
                                                       [&](std::int64_t i) { return links[i]; });
}

std::vector<Level> build_levels(std::vector<MortonCode> finest_cells, int depth) {
    std::vector<Level> levels = empty_levels(std::move(finest_cells), depth);
    for (int l = depth; l > 0; --l) {
        levels[l - 1].cells = coarsen_elements(levels[l]);
        number_unknowns(levels[l]);
    }
    number_unknowns(levels[0]);
    return levels;
}

std::vector<Level> build_levels(std::vector<MortonCode> finest_cells, RawVector<Link> links,
                                int depth) {
    std::vector<Level> levels = empty_levels(std::move(finest_cells), depth);
    for (int l = depth; l > 0; --l) {
        number_unknowns(levels[l], links);
        levels[l - 1].cells = coarsen_elements(levels[l], links);
        links = coarsen_links(links, levels[l].parents, levels[l - 1].element_count());
    }
    number_unknowns(levels[0], links);
    return levels;
}

Cell corner_of(const Cell& cell, int corner) {
    return cell + Cell(corner_bit(corner, 0), corner_bit(corner, 1), corner_bit(corner, 2));
}

std::int64_t count_cells(const Level& level) {
    return parallel_count(level.element_count(),
                          runs_by(level.cells, [](MortonCode cell) { return cell; }));
}

}  // namespace tracked_mcf
