#include "filter_tracked_mcf/core/automatic_depth.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/fragments.h"
#include "filter_tracked_mcf/core/mesh_topology.h"
#include "filter_tracked_mcf/core/octree.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/setup_phases.h"

namespace tracked_mcf {

namespace {

/// On a surface of area A (in cells²) there are about 3 A unknowns.
constexpr double kUnknownsPerArea = 3;

/// In squared units of the mesh; surface_area() adds up in another order.
double area_of(const TriangleMesh& mesh) {
    const auto count = static_cast<std::int64_t>(mesh.triangles.size());
    return 0.5 * parallel_sum(count, 0.0, [&](std::int64_t begin, std::int64_t end) {
               double twice = 0;
               for (std::int64_t i = begin; i < end; ++i) {
                   twice += twice_vector_area(mesh, mesh.triangles[i]).norm();
               }
               return twice;
           });
}

/// The depth at which a surface of this area needs as many unknowns as vertices. For a surface that
/// is much thinner than its box, whose area says little, no more than a flat square would need.
int expected_depth(const TriangleMesh& mesh, const Grid& cube, std::int64_t vertices) {
    const double area = std::max(1.0, area_of(mesh) / (cube.cell_size * cube.cell_size));
    const double depth = 0.5 * std::log2(static_cast<double>(vertices) / (kUnknownsPerArea * area));
    return static_cast<int>(std::lround(depth));
}

/// Those of their ancestors that are so many levels up, increasing, each once.
std::vector<MortonCode> ancestors(const std::vector<MortonCode>& cells, int levels) {
    const auto ancestor = [&](std::int64_t i) { return cells[i] >> (3U * unsigned(levels)); };
    return parallel_collect<MortonCode>(
        static_cast<std::int64_t>(cells.size()),
        [&](std::int64_t begin, std::int64_t end, std::vector<MortonCode>& out) {
            for (std::int64_t i = begin; i < end; ++i) {
                if (i == 0 || ancestor(i) != ancestor(i - 1)) out.push_back(ancestor(i));
            }
        });
}

/// A surface clipped at some depth, and its numbers of unknowns.
class UnknownCounter {
public:
    UnknownCounter(const TriangleMesh& mesh, const Grid& cube, int depth,
                   const std::function<void(int)>& before_clipping)
        : mesh_(mesh), cube_(cube), before_clipping_(before_clipping) {
        clip(depth);
    }

    /// Of a coarser grid than has been clipped to, the cells are the parents of those.
    std::int64_t unknowns_at(int depth) {
        if (depth > clipped_->grid.depth) clip(depth);
        const int levels = clipped_->grid.depth - depth;
        return count_unknowns(ancestors(cells_, levels));
    }

    ClippedSurface take(int depth) && {
        if (depth != clipped_->grid.depth) clip(depth);
        return std::move(*clipped_);
    }

private:
    void clip(int depth) {
        before_clipping_(depth);
        clipped_.reset();  // two would be more memory than anything else at this time
        clipped_.emplace(clip_to_grid(mesh_, with_depth(cube_, depth)));
        cells_ = occupied_cells(clipped_->fragments);
    }

    const TriangleMesh& mesh_;
    const Grid& cube_;
    const std::function<void(int)>& before_clipping_;
    std::optional<ClippedSurface> clipped_;
    std::vector<MortonCode> cells_;
};

/// See clip_at_automatic_depth.
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
            // With twice as many unknowns or more, the next depth would be farther off.
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

ClippedSurface clip_at_automatic_depth(const TriangleMesh& mesh, const Grid& cube,
                                       std::int64_t vertices,
                                       const std::function<void(int)>& before_clipping) {
    if (!has_area(mesh, cube)) return clip_to_grid(mesh, with_depth(cube, 1));
    // Counted first at the depth below, but clipped at the one that is likely to be chosen.
    const int expected = expected_depth(mesh, cube, vertices);
    UnknownCounter counter(mesh, cube, std::clamp(expected, 1, kMaximumDepth), before_clipping);
    const int depth = choose_depth(counter, std::clamp(expected - 1, 1, kMaximumDepth), vertices);
    enter_setup_phase(SetupPhase::ClipTriangles);
    return std::move(counter).take(depth);
}

int automatic_depth(const TriangleMesh& mesh) {
    const std::int64_t vertices = count_vertices(topology_of(mesh));
    return clip_at_automatic_depth(mesh, enclosing_grid(mesh, 0), vertices).grid.depth;
}

}  // namespace tracked_mcf
