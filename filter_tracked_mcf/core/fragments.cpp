#include "filter_tracked_mcf/core/fragments.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "filter_tracked_mcf/core/clip.h"
#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/sorting.h"

namespace tracked_mcf {

namespace {

constexpr double kDegenerateShape = 1e-12;

// What fits into a FragmentEntry.
constexpr std::uint64_t kCellBits = (std::uint64_t{1} << 40U) - 1;
constexpr unsigned kFlagBits = 0xff;

Eigen::Vector3d rounded(const Eigen::Vector3d& position) {
    constexpr double steps_per_cell = 0x1p30;
    return (steps_per_cell * position).array().round() / steps_per_cell;
}

unsigned corners_of(const Polygon& polygon) {
    unsigned corners = 0;
    for (int i = 0; i < polygon.size; ++i) {
        if (polygon.corner[i] != Polygon::kNone) corners |= 1U << polygon.corner[i];
    }
    return corners;
}

unsigned edges_of(const Polygon& polygon) {
    unsigned edges = 0;
    for (int i = 0; i < polygon.size; ++i) {
        const int next = i + 1 < polygon.size ? i + 1 : 0;
        if (polygon.edge[i] != Polygon::kNone && polygon.points[i] != polygon.points[next]) {
            edges |= 1U << polygon.edge[i];
        }
    }
    return edges;
}

/// Appends the fragments of a triangle; their places are still to be filled in.
void add_fragments(const std::array<Eigen::Vector3d, 3>& corners, std::int32_t triangle,
                   bool degenerate, std::int32_t cells_per_side,
                   std::vector<FragmentEntry>& fragments, Pacer& pacer) {
    for_each_fragment(corners, cells_per_side, [&](const Cell& cell, const Polygon& polygon) {
        FragmentEntry fragment{};
        fragment.cell = morton_code(cell) & kCellBits;
        fragment.split_triangles =
            degenerate ? 0U : static_cast<unsigned>(std::max(polygon.size - 2, 0)) & kFlagBits;
        fragment.corners = corners_of(polygon) & kFlagBits;
        fragment.edges = edges_of(polygon) & kFlagBits;
        fragment.triangle = triangle;
        fragments.push_back(fragment);
        pacer.did(kItemsPerFragment);
    });
}

void check_inside(const GridMesh& mesh, const Grid& grid) {
    const double side = grid.cells_per_side();
    parallel_for_rows(static_cast<std::int64_t>(mesh.positions.size()), [&](std::int32_t vertex) {
        const Eigen::Vector3d& position = mesh.positions[vertex];
        if (!(position.minCoeff() >= 0 && position.maxCoeff() <= side)) {
            throw InvalidMesh("The mesh does not lie inside the cube of the grid.");
        }
    });
}

/// The fragments triangle by triangle.
RawVector<FragmentEntry> list_fragments(ClippedSurface& surface) {
    const auto count = static_cast<std::int64_t>(surface.mesh.original.triangles.size());
    const std::int32_t cells_per_side = surface.grid.cells_per_side();
    std::atomic<std::int64_t> degenerate_count{0};
    auto fragments = parallel_collect<FragmentEntry, RawVector<FragmentEntry>>(
        count, [&](std::int64_t begin, std::int64_t end, std::vector<FragmentEntry>& out) {
            Pacer pacer;
            std::int64_t degenerate_here = 0;
            for (auto triangle = static_cast<std::int32_t>(begin); triangle < end; ++triangle) {
                const auto corners = surface.mesh.corners(triangle);
                const bool degenerate = is_degenerate(corners);
                degenerate_here += degenerate ? 1 : 0;
                add_fragments(corners, triangle, degenerate, cells_per_side, out, pacer);
            }
            degenerate_count += degenerate_here;
        });
    surface.degenerate_count = degenerate_count;
    return fragments;
}

void number_places(RawVector<FragmentEntry>& fragments) {
    if (fragments.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
        throw InvalidParameter("The octree is too deep for this mesh; choose a smaller depth.");
    }
    parallel_for_rows(static_cast<std::int64_t>(fragments.size()),
                      [&](std::int32_t place) { fragments[place].place = place; });
}

}  // namespace

GridMesh to_grid(const TriangleMesh& mesh, const Grid& grid) {
    const std::vector<std::uint8_t> referenced = referenced_vertices(mesh);
    GridMesh result{mesh, {}};
    resize(result.positions, static_cast<std::int64_t>(mesh.positions.size()));
    parallel_for_rows(static_cast<std::int64_t>(mesh.positions.size()), [&](std::int32_t vertex) {
        result.positions[vertex] = referenced[vertex] != 0
                                       ? rounded(grid.to_grid(mesh.positions[vertex]))
                                       : Eigen::Vector3d::Zero();
    });
    return result;
}

bool is_degenerate(const std::array<Eigen::Vector3d, 3>& corners) {
    const Eigen::Vector3d a = corners[1] - corners[0];
    const Eigen::Vector3d b = corners[2] - corners[0];
    const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (a - b).squaredNorm()});
    const double least = kDegenerateShape * longest;
    // Hardly any triangle is near the limit: most do without the root.
    const double squared = a.cross(b).squaredNorm();
    if (squared > 5 * least * least) return false;
    return 0.5 * std::sqrt(squared) <= least;
}

bool has_area(const TriangleMesh& mesh, const Grid& grid) {
    Pacer pacer;
    return std::any_of(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& triangle) {
        pacer.did(1);
        std::array<Eigen::Vector3d, 3> corners;
        for (int i = 0; i < 3; ++i) {
            corners[i] = rounded(grid.to_grid(mesh.positions[triangle[i]]));
        }
        return !is_degenerate(corners);
    });
}

ClippedSurface clip_to_grid(const TriangleMesh& mesh, const Grid& grid) {
    ClippedSurface surface{grid, to_grid(mesh, grid), {}, 0};
    check_inside(surface.mesh, grid);
    surface.fragments = list_fragments(surface);
    number_places(surface.fragments);
    sort_by(surface.fragments, [](const FragmentEntry& fragment) { return fragment.cell; });
    return surface;
}

std::vector<MortonCode> occupied_cells(const RawVector<FragmentEntry>& fragments) {
    return parallel_collect<MortonCode>(
        static_cast<std::int64_t>(fragments.size()),
        [&](std::int64_t begin, std::int64_t end, std::vector<MortonCode>& out) {
            for (std::int64_t i = begin; i < end; ++i) {
                if (i == 0 || fragments[i].cell != fragments[i - 1].cell) {
                    out.push_back(fragments[i].cell);
                }
            }
        });
}

}  // namespace tracked_mcf
