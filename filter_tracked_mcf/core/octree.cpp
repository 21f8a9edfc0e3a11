#include "filter_tracked_mcf/core/octree.h"

#include <algorithm>
#include <limits>
#include <string>

#include "filter_tracked_mcf/core/bspline.h"
#include "filter_tracked_mcf/core/concurrent_sets.h"
#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/sorting.h"

namespace tracked_mcf {

namespace {

void check_size(const Level& level) {
    // Corners of elements, eight each, are numbered with 32 bits.
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max() / 8;
    if (level.cells.size() > most) {
        throw InvalidParameter("The octree would have more than " + std::to_string(most) +
                               " cells; choose a smaller depth.");
    }
}

std::int64_t place_count(const Level& level) {
    return 8 * std::int64_t{level.element_count()};
}

/// Elements' corners, numbered 8 * element + corner, that have the same first(corner), one of
/// them and the smallest, become one unknown. Unknowns are numbered as their first corners are.
template <class First>
void number_unknowns(Level& level, const First& first) {
    resize(level.unknowns, level.element_count());
    const auto is_first = [&](std::int64_t place) {
        return first(static_cast<std::int32_t>(place)) == place;
    };
    level.number_of_unknowns = static_cast<std::int32_t>(number_blocks(
        place_count(level), is_first,
        [&](std::int64_t begin, std::int64_t end, std::int64_t unknown) {
            for (std::int64_t place = begin; place < end; ++place) {
                if (!is_first(place)) continue;
                level.unknowns[place / 8][place % 8] = static_cast<std::int32_t>(unknown++);
            }
        }));
    parallel_for_rows(level.element_count(), [&](std::int32_t element) {
        for (int corner = 0; corner < 8; ++corner) {
            const std::int32_t place = 8 * element + corner;
            const std::int32_t of_unknown = first(place);
            if (of_unknown == place) continue;
            level.unknowns[element][corner] = level.unknowns[of_unknown / 8][of_unknown % 8];
        }
    });
}

/// One unknown for every corner.
void number_unknowns(Level& level) {
    check_size(level);
    RawVector<KeyValue> corners(static_cast<std::size_t>(place_count(level)));
    parallel_for_rows(level.element_count(), [&](std::int32_t element) {
        const Cell cell = cell_at(level.cells[element]);
        for (int corner = 0; corner < 8; ++corner) {
            const std::int64_t place = 8 * std::int64_t{element} + corner;
            corners[place] = {morton_code(corner_of(cell, corner)),
                              static_cast<std::uint64_t>(place)};
        }
    });
    sort_by_key(corners);
    RawVector<std::int32_t> first(corners.size());
    const auto begins = [&](std::int64_t i) {
        return i == 0 || corners[i].key != corners[i - 1].key;
    };
    parallel_for_runs(place_count(level), begins, [&](std::int64_t begin, std::int64_t end) {
        for_each_run(begin, end, begins, [&](std::int64_t run_begin, std::int64_t run_end) {
            for (std::int64_t i = run_begin; i < run_end; ++i) {
                first[corners[i].value] = static_cast<std::int32_t>(corners[run_begin].value);
            }
        });
    });
    number_unknowns(level, [&](std::int32_t place) { return first[place]; });
}

/// Unites the elements' corners, numbered 8 * element + corner, at all corners that the cells of
/// two linked elements share.
void unite_shared_corners(const Link& link, const Level& level, ConcurrentSets& corners) {
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
void number_unknowns(Level& level, const RawVector<Link>& links) {
    check_size(level);
    ConcurrentSets corners(8 * level.element_count());
    parallel_for_items(links,
                       [&](const Link& link) { unite_shared_corners(link, level, corners); });
    number_unknowns(level, [&](std::int32_t place) { return corners.find(place); });
}

/// The first of every group of elements, as `first` tells, gets a number, which becomes the parent
/// of all of the group. Returns the parents' cells.
template <class First>
std::vector<MortonCode> make_parents(const std::vector<MortonCode>& cells, const First& first,
                                     std::vector<std::int32_t>& parents) {
    const auto count = static_cast<std::int64_t>(cells.size());
    const auto is_first = [&](std::int64_t i) { return first(static_cast<std::int32_t>(i)) == i; };
    parents.resize(cells.size());
    RawVector<MortonCode> coarse(cells.size());
    const std::int64_t parent_count = number_blocks(
        count, is_first, [&](std::int64_t begin, std::int64_t end, std::int64_t parent) {
            for (std::int64_t i = begin; i < end; ++i) {
                if (!is_first(i)) continue;
                coarse[parent] = parent_of(cells[i]);
                parents[i] = static_cast<std::int32_t>(parent++);
            }
        });
    parallel_for_rows(count, [&](std::int32_t i) {
        if (!is_first(i)) parents[i] = parents[first(i)];
    });
    return {coarse.begin(), coarse.begin() + parent_count};
}

/// Cells of the elements of the next coarser level: of each class of linked elements with the same
/// parent cell. And of every element its place among them.
std::vector<MortonCode> coarsen(const std::vector<MortonCode>& cells, const RawVector<Link>& links,
                                std::vector<std::int32_t>& parents) {
    ConcurrentSets siblings(static_cast<std::int32_t>(cells.size()));
    parallel_for_items(links, [&](const Link& link) {
        if (parent_of(cells[link.first]) == parent_of(cells[link.second])) {
            siblings.unite(link.first, link.second);
        }
    });
    return make_parents(
        cells, [&](std::int32_t element) { return siblings.find(element); }, parents);
}

/// The same for the elements, one in each cell, of a grid without separated sheets.
std::vector<MortonCode> coarsen(const std::vector<MortonCode>& cells,
                                std::vector<std::int32_t>& parents) {
    const auto first_sibling = [&](std::int32_t element) {
        while (element > 0 && parent_of(cells[element - 1]) == parent_of(cells[element])) {
            --element;
        }
        return element;
    };
    return make_parents(cells, first_sibling, parents);
}

/// The links between the elements of the next coarser level.
RawVector<Link> coarsen(const RawVector<Link>& links, const std::vector<std::int32_t>& parents) {
    auto coarse = parallel_collect<Link, RawVector<Link>>(
        static_cast<std::int64_t>(links.size()),
        [&](std::int64_t begin, std::int64_t end, std::vector<Link>& out) {
            for (std::int64_t i = begin; i < end; ++i) {
                const auto [first, second] =
                    std::minmax(parents[links[i].first], parents[links[i].second]);
                if (first != second) out.push_back({first, second});
            }
        });
    sort_and_remove_copies(coarse);
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

std::vector<Level> build_levels(std::vector<MortonCode> finest_cells, RawVector<Link> links,
                                int depth) {
    std::vector<Level> levels(static_cast<std::size_t>(depth) + 1);
    levels[depth].cells = std::move(finest_cells);
    for (int l = depth; l >= 0; --l) {
        levels[l].depth = l;
        number_unknowns(levels[l], links);
        if (l == 0) break;
        levels[l - 1].cells = coarsen(levels[l].cells, links, levels[l].parents);
        links = coarsen(links, levels[l].parents);
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

std::int64_t count_unknowns(const std::vector<MortonCode>& cells) {
    RawVector<MortonCode> corners(8 * cells.size());
    parallel_for_blocks(static_cast<std::int64_t>(cells.size()),
                        [&](std::int64_t begin, std::int64_t end) {
                            for (std::int64_t i = begin; i < end; ++i) {
                                const Cell cell = cell_at(cells[i]);
                                for (int corner = 0; corner < 8; ++corner) {
                                    corners[8 * i + corner] = morton_code(corner_of(cell, corner));
                                }
                            }
                        });
    sort_by(corners, [](MortonCode corner) { return corner; });
    return parallel_count(static_cast<std::int64_t>(corners.size()),
                          [&](std::int64_t i) { return i == 0 || corners[i] != corners[i - 1]; });
}

}  // namespace tracked_mcf
