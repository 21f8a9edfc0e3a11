#include "filter_tracked_mcf/core/octree.h"

#include <algorithm>
#include <limits>
#include <string>

#include "filter_tracked_mcf/core/bspline.h"
#include "filter_tracked_mcf/core/disjoint_sets.h"
#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/sorting.h"

namespace tracked_mcf {

namespace {

/// Cells of the next coarser level, and of every cell its place among them.
std::vector<MortonCode> coarsen(const std::vector<MortonCode>& cells,
                                std::vector<std::int32_t>& parents) {
    std::vector<MortonCode> coarse;
    parents.resize(cells.size());
    serial_for(static_cast<std::int64_t>(cells.size()), [&](std::int64_t element) {
        const MortonCode parent = parent_of(cells[element]);
        if (coarse.empty() || coarse.back() != parent) coarse.push_back(parent);
        parents[element] = static_cast<std::int32_t>(coarse.size()) - 1;
    });
    return coarse;
}

void check_size(const Level& level) {
    // Corners of elements, eight each, are numbered with 32 bits.
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max() / 8;
    if (level.cells.size() > most) {
        throw InvalidParameter("The octree would have more than " + std::to_string(most) +
                               " cells; choose a smaller depth.");
    }
}

/// Every element's corners, each with the place that its unknown's number has to go to.
std::vector<KeyValue> list_corners(const Level& level) {
    std::vector<KeyValue> corners;
    resize(corners, 8 * std::int64_t{level.element_count()});
    parallel_for_blocks(level.element_count(), [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t element = begin; element < end; ++element) {
            const Cell cell = cell_at(level.cells[element]);
            for (int corner = 0; corner < 8; ++corner) {
                const auto place = static_cast<std::uint64_t>(8 * element + corner);
                corners[place] = {morton_code(corner_of(cell, corner)), place};
            }
        }
    });
    return corners;
}

/// One unknown for every corner.
void number_unknowns(Level& level) {
    check_size(level);
    std::vector<KeyValue> corners = list_corners(level);
    sort_by_key(corners);
    resize(level.unknowns, level.element_count());
    serial_for(static_cast<std::int64_t>(corners.size()), [&](std::int64_t i) {
        if (i == 0 || corners[i].key != corners[i - 1].key) ++level.number_of_unknowns;
        level.unknowns[corners[i].value / 8][corners[i].value % 8] = level.unknown_count() - 1;
    });
}

/// Unites the elements' corners, numbered 8 * element + corner, at all corners that the cells of
/// two linked elements share.
void unite_shared_corners(const Link& link, const Level& level, DisjointSets& corners) {
    const Cell offset = cell_at(level.cells[link.second]) - cell_at(level.cells[link.first]);
    int of_first = 0;   // the bits that a shared corner has in the first cell,
    int of_second = 0;  // in the second,
    int free = 0;       // and those that it may have in both
    for (int axis = 0; axis < 3; ++axis) {
        const int bit = 1 << axis;
        if (offset[axis] > 0) of_first |= bit;
        if (offset[axis] < 0) of_second |= bit;
        if (offset[axis] == 0) free |= bit;
    }
    for (int chosen = free;; chosen = (chosen - 1) & free) {
        corners.unite(8 * link.first + (of_first | chosen), 8 * link.second + (of_second | chosen));
        if (chosen == 0) break;
    }
}

/// One unknown for every class of elements' corners that links unite.
void number_unknowns(Level& level, const std::vector<Link>& links) {
    check_size(level);
    DisjointSets corners(8 * level.element_count());
    for_each_item(links, [&](const Link& link) { unite_shared_corners(link, level, corners); });
    const std::vector<std::int32_t> class_of = std::move(corners).representatives();

    std::vector<KeyValue> classes;
    const std::int64_t place_count = 8 * std::int64_t{level.element_count()};
    serial_for(place_count, [&](std::int64_t place) {
        if (class_of[place] != place) return;
        const int corner = static_cast<int>(place % 8);
        classes.push_back({morton_code(corner_of(cell_at(level.cells[place / 8]), corner)),
                           static_cast<std::uint64_t>(place)});
    });
    sort_by_key(classes);
    resize(level.unknowns, level.element_count());
    for_each_item(classes, [&](const KeyValue& of_class) {
        level.unknowns[of_class.value / 8][of_class.value % 8] = level.unknown_count();
        ++level.number_of_unknowns;
    });
    serial_for(place_count, [&](std::int64_t place) {
        const std::int32_t first = class_of[place];
        level.unknowns[place / 8][place % 8] = level.unknowns[first / 8][first % 8];
    });
}

/// Cells of the elements of the next coarser level: of each class of linked elements with the same
/// parent cell. And of every element its place among them.
std::vector<MortonCode> coarsen(const std::vector<MortonCode>& cells,
                                const std::vector<Link>& links,
                                std::vector<std::int32_t>& parents) {
    const auto count = static_cast<std::int32_t>(cells.size());
    DisjointSets siblings(count);
    for_each_item(links, [&](const Link& link) {
        if (parent_of(cells[link.first]) == parent_of(cells[link.second])) {
            siblings.unite(link.first, link.second);
        }
    });
    parents = std::move(siblings).representatives();
    std::vector<MortonCode> coarse;
    serial_for(count, [&](std::int64_t element) {
        const std::int32_t first = parents[element];
        if (first == element) coarse.push_back(parent_of(cells[element]));
        parents[element] =
            first == element ? static_cast<std::int32_t>(coarse.size()) - 1 : parents[first];
    });
    return coarse;
}

/// The links between the elements of the next coarser level.
std::vector<Link> coarsen(const std::vector<Link>& links, const std::vector<std::int32_t>& parents,
                          std::int32_t parent_count) {
    std::vector<Link> coarse;
    for_each_item(links, [&](const Link& link) {
        const auto [first, second] = std::minmax(parents[link.first], parents[link.second]);
        if (first != second) coarse.push_back({first, second});
    });
    sort_and_remove_copies(coarse, parent_count);
    return coarse;
}

}  // namespace

std::vector<Level> build_levels(std::vector<MortonCode> finest_cells, int depth) {
    std::vector<Level> levels(static_cast<std::size_t>(depth) + 1);
    levels[depth].cells = std::move(finest_cells);
    for (int l = depth; l >= 0; --l) {
        levels[l].depth = l;
        if (l > 0) levels[l - 1].cells = coarsen(levels[l].cells, levels[l].parents);
        number_unknowns(levels[l]);
    }
    return levels;
}

std::vector<Level> build_levels(std::vector<MortonCode> finest_cells, std::vector<Link> links,
                                int depth) {
    std::vector<Level> levels(static_cast<std::size_t>(depth) + 1);
    levels[depth].cells = std::move(finest_cells);
    for (int l = depth; l >= 0; --l) {
        levels[l].depth = l;
        number_unknowns(levels[l], links);
        if (l == 0) break;
        levels[l - 1].cells = coarsen(levels[l].cells, links, levels[l].parents);
        links = coarsen(links, levels[l].parents, levels[l - 1].element_count());
    }
    return levels;
}

Cell corner_of(const Cell& cell, int corner) {
    return cell + Cell(corner_bit(corner, 0), corner_bit(corner, 1), corner_bit(corner, 2));
}

std::int64_t count_cells(const Level& level) {
    std::int64_t count = 0;
    for (std::size_t element = 0; element < level.cells.size(); ++element) {
        count += element == 0 || level.cells[element] != level.cells[element - 1] ? 1 : 0;
    }
    return count;
}

std::int64_t count_unknowns(std::vector<MortonCode> cells, int depth) {
    Level level;
    level.depth = depth;
    level.cells = std::move(cells);
    number_unknowns(level);
    return level.unknown_count();
}

}  // namespace tracked_mcf
