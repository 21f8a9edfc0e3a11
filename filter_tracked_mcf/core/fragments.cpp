#include "filter_tracked_mcf/core/fragments.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "filter_tracked_mcf/core/clip.h"
#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/sorting.h"

namespace tracked_mcf {

namespace {

constexpr double kDegenerateShape = 1e-12;

// What is sorted with a cell's code: the triangle in the lowest bits, the rest above.
constexpr unsigned kFanShift = 32;
constexpr unsigned kCornersShift = 40;
constexpr unsigned kEdgesShift = 48;

std::uint64_t pack(const FragmentEntry& entry) {
    return static_cast<std::uint64_t>(entry.triangle) |
           static_cast<std::uint64_t>(entry.split_triangles) << kFanShift |
           static_cast<std::uint64_t>(entry.corners) << kCornersShift |
           static_cast<std::uint64_t>(entry.edges) << kEdgesShift;
}

FragmentEntry unpack(const KeyValue& pair) {
    return {pair.key, static_cast<std::int32_t>(pair.value),
            static_cast<std::uint8_t>(pair.value >> kFanShift),
            static_cast<std::uint8_t>(pair.value >> kCornersShift),
            static_cast<std::uint8_t>(pair.value >> kEdgesShift)};
}

Eigen::Vector3d rounded(const Eigen::Vector3d& position) {
    constexpr double steps_per_cell = 0x1p30;
    return (steps_per_cell * position).array().round() / steps_per_cell;
}

std::uint8_t corners_of(const Polygon& polygon) {
    int corners = 0;
    for (int i = 0; i < polygon.size; ++i) {
        if (polygon.corner[i] != Polygon::kNone) corners |= 1 << polygon.corner[i];
    }
    return static_cast<std::uint8_t>(corners);
}

std::uint8_t edges_of(const Polygon& polygon) {
    int edges = 0;
    for (int i = 0; i < polygon.size; ++i) {
        const int next = i + 1 < polygon.size ? i + 1 : 0;
        if (polygon.edge[i] != Polygon::kNone && polygon.points[i] != polygon.points[next]) {
            edges |= 1 << polygon.edge[i];
        }
    }
    return static_cast<std::uint8_t>(edges);
}

void add_fragments(const GridMesh& mesh, std::int32_t triangle, std::int32_t cells_per_side,
                   std::vector<KeyValue>& pairs, Pacer& pacer) {
    const auto corners = mesh.corners(triangle);
    const bool degenerate = is_degenerate(corners);
    for_each_fragment(corners, cells_per_side, [&](const Cell& cell, const Polygon& polygon) {
        const int fan = degenerate ? 0 : std::max(polygon.size - 2, 0);
        const FragmentEntry entry{morton_code(cell), triangle, static_cast<std::uint8_t>(fan),
                                  corners_of(polygon), edges_of(polygon)};
        pairs.push_back({entry.cell, pack(entry)});
        pacer.did(kItemsPerFragment);
    });
}

void check_inside(const GridMesh& mesh, const Grid& grid) {
    const double side = grid.cells_per_side();
    for_each_item(mesh.positions, [&](const Eigen::Vector3d& position) {
        if (!(position.minCoeff() >= 0 && position.maxCoeff() <= side)) {
            throw InvalidMesh("The mesh does not lie inside the cube of the grid.");
        }
    });
}

}  // namespace

std::array<Eigen::Vector3d, 3> GridMesh::corners(std::int32_t triangle) const {
    const Triangle& vertices = original.triangles[triangle];
    return {positions[vertices[0]], positions[vertices[1]], positions[vertices[2]]};
}

GridMesh to_grid(const TriangleMesh& mesh, const Grid& grid) {
    const std::vector<bool> referenced = referenced_vertices(mesh);
    GridMesh result{mesh, {}};
    result.positions.reserve(mesh.positions.size());
    serial_for(static_cast<std::int64_t>(mesh.positions.size()), [&](std::int64_t vertex) {
        result.positions.emplace_back(referenced[vertex]
                                          ? rounded(grid.to_grid(mesh.positions[vertex]))
                                          : Eigen::Vector3d::Zero());
    });
    return result;
}

bool is_degenerate(const std::array<Eigen::Vector3d, 3>& corners) {
    const Eigen::Vector3d a = corners[1] - corners[0];
    const Eigen::Vector3d b = corners[2] - corners[0];
    const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (a - b).squaredNorm()});
    return 0.5 * a.cross(b).norm() <= kDegenerateShape * longest;
}

std::int64_t count_degenerate(const GridMesh& mesh) {
    std::int64_t count = 0;
    serial_for(static_cast<std::int64_t>(mesh.original.triangles.size()), [&](std::int64_t i) {
        count += is_degenerate(mesh.corners(static_cast<std::int32_t>(i))) ? 1 : 0;
    });
    return count;
}

std::vector<FragmentEntry> list_fragments(const GridMesh& mesh, const Grid& grid) {
    check_inside(mesh, grid);
    const auto count = static_cast<std::int64_t>(mesh.original.triangles.size());
    auto pairs = parallel_collect<KeyValue>(
        count, [&](std::int64_t begin, std::int64_t end, std::vector<KeyValue>& out) {
            Pacer pacer;
            for (std::int64_t triangle = begin; triangle < end; ++triangle) {
                add_fragments(mesh, static_cast<std::int32_t>(triangle), grid.cells_per_side(), out,
                              pacer);
            }
        });
    sort_by_key(pairs);
    std::vector<FragmentEntry> entries;
    entries.reserve(pairs.size());
    for_each_item(pairs, [&](const KeyValue& pair) { entries.push_back(unpack(pair)); });
    return entries;
}

std::vector<MortonCode> occupied_cells(const std::vector<FragmentEntry>& entries) {
    std::vector<MortonCode> cells;
    for_each_item(entries, [&](const FragmentEntry& entry) {
        if (cells.empty() || cells.back() != entry.cell) cells.push_back(entry.cell);
    });
    return cells;
}

}  // namespace tracked_mcf
