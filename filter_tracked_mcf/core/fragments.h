#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/grid.h"
#include "filter_tracked_mcf/core/morton.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// A mesh in the coordinates of a grid, for clipping: rounded to 2^-30 of a cell. What lies in a
/// grid plane but for rounding errors then lies in it; else it would be cut along a line that is
/// nothing but rounding, into parts that overlap.
struct GridMesh {
    const TriangleMesh& original;
    std::vector<Eigen::Vector3d> positions;  ///< zero where unreferenced

    std::array<Eigen::Vector3d, 3> corners(std::int32_t triangle) const;
};

GridMesh to_grid(const TriangleMesh& mesh, const Grid& grid);

/// Whether a triangle has, to the accuracy of doubles, no area and so no plane: less than 1e-12 of
/// the square of its longest edge.
bool is_degenerate(const std::array<Eigen::Vector3d, 3>& corners);

std::int64_t count_degenerate(const GridMesh& mesh);

/// Which triangle has a part in which cell, and which of the triangle's corners and edges have.
/// Degenerate triangles are listed too: they carry no area, but they hold the surface together and
/// their vertices need functions.
struct FragmentEntry {
    MortonCode cell;
    std::int32_t triangle;
    std::uint8_t split_triangles;  ///< triangles in the polygon's fan; 0 if degenerate
    std::uint8_t corners;          ///< bit i: corner i of the triangle lies in the cell
    std::uint8_t edges;  ///< bit i: so does, in more than a point, the edge from corner i on
};

/// Light items (interruptible.h) that clipping one fragment takes as long as. A large triangle may
/// have millions of fragments, a cell as many.
inline constexpr std::int64_t kItemsPerFragment = 64;

/// All fragments of a mesh, sorted by cell, then by triangle. Throws InvalidMesh if a vertex lies
/// outside the grid's cube.
std::vector<FragmentEntry> list_fragments(const GridMesh& mesh, const Grid& grid);

/// The cells that fragments lie in, increasing, each once.
std::vector<MortonCode> occupied_cells(const std::vector<FragmentEntry>& entries);

}  // namespace tracked_mcf
