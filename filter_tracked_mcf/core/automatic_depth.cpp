#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "filter_tracked_mcf/core/fragments.h"
#include "filter_tracked_mcf/core/tracked_elements.h"

namespace tracked_mcf {

namespace {

/// On a surface of area A (in cells²) there are about 3 A unknowns.
constexpr double kUnknownsPerArea = 3;

/// The depth at which about as many unknowns as vertices are to be expected, rounded up.
int expected_depth(const TriangleMesh& mesh, std::int64_t vertices) {
    const Grid cube = enclosing_grid(mesh, 0);
    const double area = surface_area(mesh) / (cube.cell_size * cube.cell_size);
    if (!(area > 0)) return 1;
    const double depth = 0.5 * std::log2(static_cast<double>(vertices) / (kUnknownsPerArea * area));
    return static_cast<int>(std::clamp(std::ceil(depth), 1.0, static_cast<double>(kMaximumDepth)));
}

/// Numbers of unknowns of every level, coarsest first.
std::vector<std::int64_t> count_unknowns(const TriangleMesh& mesh, int depth) {
    const Grid grid = enclosing_grid(mesh, depth);
    std::vector<std::int64_t> counts;
    for (const Level& level :
         build_levels(occupied_cells(list_fragments(to_grid(mesh, grid), grid)), depth)) {
        counts.push_back(level.unknown_count());
    }
    return counts;
}

}  // namespace

int automatic_depth(const TriangleMesh& mesh) {
    const std::vector<bool> referenced = referenced_vertices(mesh);
    const std::int64_t vertices = std::count(referenced.begin(), referenced.end(), true);
    int deepest = expected_depth(mesh, vertices);
    std::vector<std::int64_t> unknowns = count_unknowns(mesh, deepest);
    while (unknowns.back() < vertices && deepest < kMaximumDepth) {
        unknowns = count_unknowns(mesh, ++deepest);
    }
    const auto nearest =
        std::min_element(unknowns.begin() + 1, unknowns.end(), [&](std::int64_t a, std::int64_t b) {
            return std::abs(a - vertices) < std::abs(b - vertices);
        });
    return static_cast<int>(nearest - unknowns.begin());
}

}  // namespace tracked_mcf
