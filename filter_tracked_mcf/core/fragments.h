#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/grid.h"
#include "filter_tracked_mcf/core/morton.h"
#include "filter_tracked_mcf/core/raw_vector.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// A mesh in the coordinates of a grid, for clipping: rounded to 2^-30 of a cell. What lies in a
/// grid plane but for rounding errors then lies in it; else it would be cut along a line that is
/// nothing but rounding, into parts that overlap.
struct GridMesh {
    const TriangleMesh& original;
    RawVector<Eigen::Vector3d> positions;  ///< zero where unreferenced

    std::array<Eigen::Vector3d, 3> corners(std::int32_t triangle) const {
        const Triangle& vertices = original.triangles[triangle];
        return {positions[vertices[0]], positions[vertices[1]], positions[vertices[2]]};
    }
};

GridMesh to_grid(const TriangleMesh& mesh, const Grid& grid);

/// Whether a triangle has, to the accuracy of doubles, no area and so no plane: less than 1e-12 of
/// the square of its longest edge.
bool is_degenerate(const std::array<Eigen::Vector3d, 3>& corners);

/// Whether any triangle is not degenerate in the coordinates of this grid.
bool has_area(const TriangleMesh& mesh, const Grid& grid);

/// Which triangle has a part in which cell, and which of the triangle's corners and edges have.
/// Degenerate triangles are listed too: they carry no area, but they hold the surface together and
/// their vertices need functions. There are many of these, hence the bit-fields.
struct FragmentEntry {
    MortonCode cell : 40;
    std::uint64_t split_triangles : 8;  ///< triangles in the polygon's fan; 0 if degenerate
    std::uint64_t corners : 8;          ///< bit i: corner i of the triangle lies in the cell
    std::uint64_t edges : 8;  ///< bit i: so does, in more than a point, the edge from corner i on
    std::int32_t triangle;
    std::int32_t place;  ///< in the order of triangles: each has consecutive ones
};
static_assert(3 * kMaximumDepth <= 40 && sizeof(FragmentEntry) == 16);

/// Light items (interruptible.h) that clipping one fragment takes as long as. A large triangle may
/// have millions of fragments, a cell as many.
inline constexpr std::int64_t kItemsPerFragment = 64;

/// A surface in the coordinates of a grid, and its fragments.
struct ClippedSurface {
    Grid grid;
    GridMesh mesh;
    RawVector<FragmentEntry> fragments;  ///< sorted by cell, then by triangle
    std::int64_t degenerate_count = 0;   ///< of triangles, see is_degenerate
};

/// Throws InvalidMesh if a vertex lies outside the grid's cube, InvalidParameter if there are more
/// fragments than can be numbered.
ClippedSurface clip_to_grid(const TriangleMesh& mesh, const Grid& grid);

/// The cells that fragments lie in, increasing, each once.
std::vector<MortonCode> occupied_cells(const RawVector<FragmentEntry>& fragments);

}  // namespace tracked_mcf
