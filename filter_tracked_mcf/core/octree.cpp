#include "filter_tracked_mcf/core/octree.h"

#include <algorithm>
#include <limits>
#include <string>

#include "filter_tracked_mcf/core/bspline.h"
#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/sorting.h"

namespace tracked_mcf {

namespace {

/// Cells of the next coarser level, and of every cell its place among them.
std::vector<MortonCode> coarsen(const std::vector<MortonCode>& cells,
                                std::vector<std::int32_t>& parents) {
    std::vector<MortonCode> coarse;
    parents.resize(cells.size());
    for (std::size_t element = 0; element < cells.size(); ++element) {
        const MortonCode parent = parent_of(cells[element]);
        if (coarse.empty() || coarse.back() != parent) coarse.push_back(parent);
        parents[element] = static_cast<std::int32_t>(coarse.size()) - 1;
    }
    return coarse;
}

/// Numbers of the grid's corners in lexicographic order, x fastest.
struct CornerNumbering {
    std::uint64_t corners_per_side;

    std::uint64_t number(const Cell& cell, int corner) const {
        const auto coordinate = [&](int axis) {
            return static_cast<std::uint64_t>(cell[axis]) +
                   static_cast<std::uint64_t>(corner_bit(corner, axis));
        };
        return (coordinate(2) * corners_per_side + coordinate(1)) * corners_per_side +
               coordinate(0);
    }
    std::int32_t layer(std::uint64_t number) const {
        return static_cast<std::int32_t>(number / (corners_per_side * corners_per_side));
    }
};

/// Every element's corners, each with the place that its unknown's number has to go to.
std::vector<KeyValue> list_corners(const Level& level, const CornerNumbering& numbering) {
    std::vector<KeyValue> corners(8 * level.cells.size());
    parallel_for_blocks(level.element_count(), [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t element = begin; element < end; ++element) {
            const Cell cell = cell_at(level.cells[element]);
            for (int corner = 0; corner < 8; ++corner) {
                const auto place = static_cast<std::uint64_t>(8 * element + corner);
                corners[place] = {numbering.number(cell, corner), place};
            }
        }
    });
    return corners;
}

void number_unknowns(Level& level) {
    // Corners of elements, eight each, are numbered with 32 bits.
    constexpr std::size_t most = std::numeric_limits<std::int32_t>::max() / 8;
    if (level.cells.size() > most) {
        throw InvalidParameter("The octree would have more than " + std::to_string(most) +
                               " cells; choose a smaller depth.");
    }
    const CornerNumbering numbering{(std::uint64_t{1} << static_cast<unsigned>(level.depth)) + 1};
    std::vector<KeyValue> corners = list_corners(level, numbering);
    sort_by_key(corners);
    level.unknowns.resize(level.cells.size());
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (i == 0 || corners[i].key != corners[i - 1].key) {
            level.layers.push_back(numbering.layer(corners[i].key));
        }
        level.unknowns[corners[i].value / 8][corners[i].value % 8] = level.unknown_count() - 1;
    }
    level.layers.shrink_to_fit();
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

std::int64_t count_unknowns(std::vector<MortonCode> cells, int depth) {
    Level level;
    level.depth = depth;
    level.cells = std::move(cells);
    number_unknowns(level);
    return level.unknown_count();
}

}  // namespace tracked_mcf
