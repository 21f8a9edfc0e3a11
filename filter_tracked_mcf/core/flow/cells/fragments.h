// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/mesh/grid.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Triangles by reference.
class Triangles {
public:
    template <class Allocator>
    Triangles(const std::vector<Triangle, Allocator>& triangles)
        : first_(triangles.data()), count_(triangles.size()) {}

    std::size_t size() const { return count_; }
    const Triangle& operator[](std::size_t i) const { return first_[i]; }

private:
    const Triangle* first_;
    std::size_t count_;
};

/// A surface by reference: triangles, and positions that need not be those of their mesh.
struct SurfaceView {
    SurfaceView(const std::vector<Eigen::Vector3d>& vertex_positions, Triangles vertex_indices)
        : positions(vertex_positions), triangles(vertex_indices) {}
    SurfaceView(const TriangleMesh& mesh) : SurfaceView(mesh.positions, mesh.triangles) {}

    const std::vector<Eigen::Vector3d>& positions;
    Triangles triangles;
};

/// A mesh in grid coordinates, for clipping. Positions are rounded to 2^-30 of a cell, so a face
/// that misses a grid plane by rounding errors lies in the plane. Otherwise the plane would cut the
/// face along a line of rounding errors, into parts that overlap.
struct GridMesh {
    Triangles triangles;  ///< those of the mesh, which must outlive this
    RawVector<Eigen::Vector3d> positions;

    std::array<Eigen::Vector3d, 3> corners(std::int32_t triangle) const {
        const Triangle& vertices = triangles[triangle];
        return {positions[vertices[0]], positions[vertices[1]], positions[vertices[2]]};
    }
};

/// Returns the mesh in the coordinates of a grid.
GridMesh to_grid(const SurfaceView& mesh, const Grid& grid);

/// A fragment: a (triangle, cell) pair, with flags of the triangle's corners and sides inside the
/// closed cell. Degenerate triangles have fragments too: they carry no area, but their vertices
/// need test functions. Bit-fields save memory: a surface has many fragments.
struct FragmentEntry {
    MortonCode cell : 40;
    std::uint64_t split_triangles : 16;  ///< triangles in the polygon's fan; 0 if degenerate
    std::uint64_t corners : 4;           ///< bit i: corner i of the triangle lies in the cell
    std::uint64_t edges : 4;  ///< bit i: more than a point of side i of the triangle does
    std::int32_t triangle;
};
static_assert(3 * kMaximumDepth <= 40 && sizeof(FragmentEntry) == 16);

/// FragmentEntry::corners of a triangle that lies in one cell.
inline constexpr unsigned kAllCorners = 7;

/// Clipping one fragment takes as long as this many light items (Pacer). A large triangle
/// may have millions of fragments, and so may a cell.
inline constexpr std::int64_t kItemsPerFragment = 64;

/// A surface in grid coordinates and its fragments.
struct ClippedSurface {
    Grid grid;
    GridMesh mesh;
    RawVector<FragmentEntry> fragments;  ///< sorted by cell, then by triangle
    std::int64_t degenerate_count = 0;   ///< number of degenerate triangles
};

/// Clips a mesh to the cells of a grid. Throws InvalidMesh if a referenced vertex lies outside the
/// grid's cube, InvalidParameter if there are more fragments than can be numbered.
ClippedSurface clip_to_grid(const SurfaceView& mesh, const Grid& grid);

}  // namespace tracked_mcf
