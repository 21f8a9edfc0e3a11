// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/octree/automatic_depth.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/octree/octree.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/setup_phases.h"
#include "filter_tracked_mcf/core/parallel/sorting.h"

namespace tracked_mcf {

namespace {

/// A surface of area A, in squared sides of a cell, has about 3 A unknowns.
constexpr double kUnknownsPerArea = 3;

/// Separate sheets have many more unknowns than their cells' corners if they are expected to have
/// this many times as many. The expected number of an ordinary surface is a few per cent off.
constexpr double kMuchMore = 1.5;

/// A grid expresses no wave shorter than two cells.
constexpr double kCellsPerDetail = 2;

/// An edge that is kept bends within a cell or two, which must be less than the detail size.
constexpr double kCellsPerKeptEdge = 4;

/// The same for the default detail size and greater ones. A grid with about as many unknowns as
/// vertices has 0.95 to 2.2 cells per default detail size.
constexpr double kCellsPerDefaultDetail = 0.9;

/// Allows for the digits that a host rounds the default detail size to.
constexpr double kAlmost = 0.99;

/// The automatic depth is at most this much greater for the detail size. Each depth more has about
/// four times as many unknowns.
constexpr int kMostDeeper = 2;

/// Returns the depth at which a surface of this area is expected to have as many unknowns as
/// vertices. The area says little about a surface much thinner than its box, so at least the area
/// of a flat square is assumed.
int expected_depth(const SurfaceView& mesh, const Grid& cube, std::int64_t vertices) {
    const double area = std::max(1.0, surface_area(mesh) / (cube.cell_size * cube.cell_size));
    const double depth = 0.5 * std::log2(static_cast<double>(vertices) / (kUnknownsPerArea * area));
    return static_cast<int>(std::lround(depth));
}

/// Returns the ancestors of sorted cells `levels` levels up, increasing, each once.
std::vector<MortonCode> ancestors(const std::vector<MortonCode>& cells, int levels) {
    const auto ancestor = [&](MortonCode cell) { return cell >> (3U * unsigned(levels)); };
    return parallel_collect_if<MortonCode>(static_cast<std::int64_t>(cells.size()),
                                           runs_by(cells, ancestor),
                                           [&](std::int64_t i) { return ancestor(cells[i]); });
}

/// Returns the number of different corners of cells.
std::int64_t count_corners(const std::vector<MortonCode>& cells) {
    RawVector<MortonCode> corners(8 * cells.size());
    parallel_for_rows(static_cast<std::int64_t>(cells.size()), [&](std::int32_t i) {
        const Cell cell = cell_at(cells[i]);
        for (int corner = 0; corner < 8; ++corner) {
            corners[8 * std::int64_t{i} + corner] = morton_code(corner_of(cell, corner));
        }
    });
    const auto code = [](MortonCode corner) { return corner; };
    sort_by(corners, code);
    return parallel_count(static_cast<std::int64_t>(corners.size()), runs_by(corners, code));
}

/// Clips a mesh and counts its unknowns at several depths.
class UnknownCounter {
public:
    UnknownCounter(const SurfaceView& mesh, const Grid& cube, const MemoryCheck& memory, int depth)
        : mesh_(mesh), cube_(cube), memory_(memory) {
        clip(depth);
    }

    /// Clips again only for a depth greater than that of the last clipping: the cells of a coarser
    /// grid are ancestors of those of a finer one.
    std::int64_t unknowns_at(int depth) {
        if (depth > clipped_->grid.depth) clip(depth);
        const std::int64_t corners = count_corners(ancestors(cells_, clipped_->grid.depth - depth));
        const double separate = memory_.separate_unknowns(depth);
        return separate > kMuchMore * static_cast<double>(corners)
                   ? static_cast<std::int64_t>(separate)
                   : corners;
    }

    ClippedSurface take(int depth) && {
        if (depth != clipped_->grid.depth) clip(depth);
        return std::move(*clipped_);
    }

private:
    void clip(int depth) {
        memory_.before_clipping(depth);
        clipped_.reset();  // two clipped surfaces at once would set the peak of memory use
        clipped_.emplace(clip_to_grid(mesh_, with_depth(cube_, depth)));
        cells_ = occupied_cells(clipped_->fragments);
    }

    const SurfaceView& mesh_;
    const Grid& cube_;
    const MemoryCheck& memory_;
    std::optional<ClippedSurface> clipped_;
    std::vector<MortonCode> cells_;
};

/// Returns the depth whose number of unknowns is nearest to `vertices`, starting the search at
/// `first_depth`.
int choose_depth(UnknownCounter& counter, int first_depth, std::int64_t vertices) {
    constexpr std::int64_t not_counted = -1;
    std::int64_t finer = not_counted;
    int depth = first_depth;
    std::int64_t unknowns = counter.unknowns_at(depth);
    while (unknowns >= vertices && depth > 1) {
        finer = unknowns;
        unknowns = counter.unknowns_at(--depth);
    }
    while (unknowns < vertices && depth < kMaximumDepth) {
        if (finer == not_counted) {
            // The next depth has at least twice as many unknowns, so it would be farther off.
            if (3 * unknowns >= 2 * vertices) return depth;
            finer = counter.unknowns_at(depth + 1);
        }
        if (finer >= vertices) {
            return vertices - unknowns <= finer - vertices ? depth : depth + 1;
        }
        ++depth;
        unknowns = finer;
        finer = not_counted;
    }
    return depth;
}

}  // namespace

int resolving_depth(const SurfaceView& mesh, const Grid& grid, const FlowParameters& parameters) {
    if (parameters.step_size > 0) return 0;
    const double mean_edge = mean_edge_length(mesh);
    const double detail_size = detail_size_of(parameters, mean_edge);
    const bool is_fine = detail_size < kAlmost * kDefaultDetailInEdges * mean_edge;
    const double per_detail = parameters.keep_edges > 0 ? kCellsPerKeptEdge
                              : is_fine                 ? kCellsPerDetail
                                                        : kCellsPerDefaultDetail;
    const double cells = per_detail * grid.cell_size * grid.cells_per_side() / detail_size;
    return static_cast<int>(std::clamp(std::ceil(std::log2(cells)), 1.0, double{kMaximumDepth}));
}

ClippedSurface clip_at_automatic_depth(const SurfaceView& mesh, const Grid& cube,
                                       std::int64_t vertices, int least_depth,
                                       const MemoryCheck& memory) {
    if (!has_area(mesh, cube)) return clip_to_grid(mesh, with_depth(cube, 1));
    // The search starts one depth below the expected one, but the mesh is clipped at the expected
    // one, since that is most often the result.
    const int expected = expected_depth(mesh, cube, vertices);
    UnknownCounter counter(mesh, cube, memory, std::clamp(expected, 1, kMaximumDepth));
    const int least = choose_depth(counter, std::clamp(expected - 1, 1, kMaximumDepth), vertices);
    int depth = std::clamp(least_depth, least, std::min(least + kMostDeeper, kMaximumDepth));
    while (depth > least && !memory.fits(depth)) --depth;
    enter_setup_phase(kClipTriangles);
    return std::move(counter).take(depth);
}

}  // namespace tracked_mcf
