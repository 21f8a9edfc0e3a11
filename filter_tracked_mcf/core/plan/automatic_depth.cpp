// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/plan/automatic_depth.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/mesh/mesh_topology.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// A surface has about this many unknowns for each of its cells.
constexpr double kUnknownsPerCell = 2;

/// A surface with threads thinner than a cell has more than this many times the expected cells.
constexpr double kMuchMore = 1.5;

/// A surface is clipped first at a depth with at most this many fragments for each triangle. Few
/// surfaces have more at their own depth.
constexpr double kFewFragments = 32;

/// A grid expresses no wave shorter than two cells.
constexpr double kCellsPerDetail = 2;

/// The same for the default detail size and greater ones. A grid with about as many unknowns as
/// vertices has 0.95 to 2.2 cells per default detail size.
constexpr double kCellsPerDefaultDetail = 0.9;

/// Allows for the digits that a host rounds the default detail size to.
constexpr double kAlmost = 0.99;

/// The automatic depth is at most this much greater for the detail size. Each depth more has about
/// four times as many unknowns.
constexpr int kMostDeeper = 2;

/// Returns the expected number of unknowns on a grid, with separate sheets. It leaves out the eight
/// unknowns that each connected component has at any depth. If these alone outnumber the vertices,
/// the components are single triangles, and it leaves out the unknowns along their rims, too.
double expected_unknowns(SurfaceSize size, const Grid& grid) {
    constexpr double unknowns_of_any_component = 8;
    if (unknowns_of_any_component * size.characteristic > size.vertices) size.rim = 0;
    size.characteristic = 0;
    return expected_counts(size, grid, {}).unknowns;
}

/// Returns the number of cells at a depth, at most that of the clipping.
std::int64_t count_cells(const ClippedSurface& surface, int depth) {
    const unsigned bits = 3 * static_cast<unsigned>(surface.grid.depth - depth);
    const auto cell = [bits](const FragmentEntry& fragment) { return fragment.cell >> bits; };
    return parallel_count(static_cast<std::int64_t>(surface.fragments.size()),
                          runs_by(surface.fragments, cell));
}

/// Returns the depth, 1 to `most`, for which unknowns(depth), an increasing number, is nearest to
/// `wanted`.
template <class Unknowns>
int nearest_depth(const Unknowns& unknowns, double wanted, int most) {
    const auto distance = [&](int depth) { return std::abs(unknowns(depth) - wanted); };
    int nearest = 1;
    while (nearest < most && distance(nearest + 1) <= distance(nearest)) ++nearest;
    return nearest;
}

/// Returns the greatest depth with few fragments.
int deepest_with_few_fragments(const SurfaceSize& size, const Grid& cube) {
    int depth = 1;
    const auto has_few = [&](int deeper) {
        return expected_counts(size, with_depth(cube, deeper), {}).fragments <=
               kFewFragments * size.triangles;
    };
    while (depth < kMaximumDepth && has_few(depth + 1)) ++depth;
    return depth;
}

}  // namespace

int resolving_depth(double detail_size, double mean_edge, const Grid& grid) {
    const bool is_fine = detail_size < kAlmost * kDefaultDetailInEdges * mean_edge;
    const double per_detail = is_fine ? kCellsPerDetail : kCellsPerDefaultDetail;
    const double cells = per_detail * grid.cell_size * grid.cells_per_side() / detail_size;
    return static_cast<int>(std::clamp(std::ceil(std::log2(cells)), 1.0, double{kMaximumDepth}));
}

ClippedSurface clip_at_automatic_depth(const Domain& domain, const SurfaceSize& size,
                                       const Grid& cube, int least_depth,
                                       const MemoryCheck& memory) {
    const auto expected = [&](int depth) {
        return expected_unknowns(size, with_depth(cube, depth));
    };
    const auto clip = [&](int balanced) {
        int depth =
            std::clamp(least_depth, balanced, std::min(balanced + kMostDeeper, kMaximumDepth));
        while (depth > balanced && !memory.fits(depth)) --depth;
        memory.before_clipping(depth);
        return clip_to_grid(domain.surface(), with_depth(cube, depth));
    };
    const auto vertices = static_cast<double>(count_vertices(domain.topology()));
    int balanced = size.shadows > 0 ? nearest_depth(expected, vertices, kMaximumDepth) : 1;
    const int first = std::min(balanced, deepest_with_few_fragments(size, cube));
    std::optional<ClippedSurface> surface(clip(first));
    const auto counted = [&](int depth) {
        return kUnknownsPerCell * static_cast<double>(count_cells(*surface, depth));
    };
    if (counted(first) > kMuchMore * expected(first))
        balanced = nearest_depth(counted, vertices, first);
    if (balanced != first) {
        surface.reset();  // two clipped surfaces at once would set the peak of memory use
        surface.emplace(clip(balanced));
    }
    memory.before_flow(surface->grid.depth);
    return *std::move(surface);
}

}  // namespace tracked_mcf
