#include "filter_tracked_mcf/core/automatic_depth.h"

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/fragments.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/octree.h"

namespace tracked_mcf {

namespace {

/// On a surface of area A (in cells²) there are about 3 A unknowns.
constexpr double kUnknownsPerArea = 3;

std::int64_t count_distinct_vertices(const TriangleMesh& mesh) {
    const std::vector<bool> referenced = referenced_vertices(mesh);
    const std::vector<std::int32_t> welded = weld_coincident_vertices(mesh);
    std::int64_t count = 0;
    serial_for(static_cast<std::int64_t>(welded.size()), [&](std::int64_t vertex) {
        count += referenced[vertex] && welded[vertex] == vertex ? 1 : 0;
    });
    return count;
}

/// A depth from which to count upwards: one less than what a surface of this area needs for as many
/// unknowns as vertices. Of a surface that is much thinner than its box, whose area says little, no
/// more than a flat square would need.
int first_depth(const TriangleMesh& mesh, const Grid& cube, std::int64_t vertices) {
    const double area = std::max(1.0, surface_area(mesh) / (cube.cell_size * cube.cell_size));
    const double depth = 0.5 * std::log2(static_cast<double>(vertices) / (kUnknownsPerArea * area));
    return std::clamp(static_cast<int>(std::lround(depth)) - 1, 1, kMaximumDepth);
}

std::int64_t unknowns_at(int depth, const TriangleMesh& mesh, const Grid& cube) {
    const Grid grid = with_depth(cube, depth);
    return count_unknowns(occupied_cells(list_fragments(to_grid(mesh, grid), grid)), depth);
}

bool has_area(const TriangleMesh& mesh, const Grid& cube) {
    const GridMesh in_cube = to_grid(mesh, cube);
    return count_degenerate(in_cube) < static_cast<std::int64_t>(mesh.triangles.size());
}

}  // namespace

int automatic_depth(const TriangleMesh& mesh) {
    return automatic_depth(mesh, enclosing_grid(mesh, 0));
}

int automatic_depth(const TriangleMesh& mesh, const Grid& cube) {
    if (!has_area(mesh, cube)) return 1;
    const std::int64_t vertices = count_distinct_vertices(mesh);
    constexpr std::int64_t not_counted = -1;
    std::int64_t finer = not_counted;
    int depth = first_depth(mesh, cube, vertices);
    std::int64_t unknowns = unknowns_at(depth, mesh, cube);
    while (unknowns >= vertices && depth > 1) {
        finer = unknowns;
        unknowns = unknowns_at(--depth, mesh, cube);
    }
    while (unknowns < vertices && depth < kMaximumDepth) {
        if (finer == not_counted) {
            // With twice as many unknowns or more, the next depth would be farther off.
            if (3 * unknowns >= 2 * vertices) return depth;
            finer = unknowns_at(depth + 1, mesh, cube);
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

}  // namespace tracked_mcf
