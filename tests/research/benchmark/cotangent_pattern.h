// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/triangle_mesh.h"
#include "tests/research/benchmark/triangle_indices.h"
#include "tests/research/benchmark/vertex_order.h"

namespace tracked_mcf::benchmark {

/// An edge between two unknowns of different blocks.
struct Coupling {
    std::int32_t row;
    std::int32_t column;
};

/// The constant structure of the cotangent flow's matrix: the numbering of its rows, its entries,
/// and the entries that each triangle adds to.
///
/// The symmetric matrix is cut into diagonal blocks of consecutive rows, one for each thread. It
/// has an entry for each edge of the mesh: first the edges inside the blocks, by rows and columns
/// of the upper triangle; then the couplings; then the edges between an unknown and a constrained
/// vertex. The last entry is for all edges between constrained vertices and is never read.
struct CotangentPattern {
    static constexpr std::int32_t kNone = -1;

    std::int32_t vertex_count = 0;
    std::int32_t unknown_count = 0;          ///< constrained vertices are numbered after them
    std::vector<std::int32_t> number;        ///< for each vertex of the mesh
    std::vector<std::int32_t> block_begin;   ///< first row of each block, and the end
    std::vector<std::int32_t> upper_begin;   ///< entries right of the diagonal, for each row
    std::vector<std::int32_t> upper_column;  ///< the columns of these entries
    std::vector<std::int32_t> lower_begin;   ///< the same left of the diagonal
    std::vector<std::int32_t> lower_column;
    std::vector<std::int32_t>
        lower_index;  ///< index in lower_column, for each entry of the upper triangle
    std::vector<Coupling> couplings;
    std::vector<std::int32_t> constrained_edge_rows;
    std::vector<TriangleIndices> triangles;
    std::vector<std::int64_t>
        triangle_begin;  ///< for each block, then for triangles of several blocks, and the end

    /// Eliminating a row changes the entry (a, b) for each pair a < b of its upper columns. `fill`
    /// has the index of this entry, or kNone if the matrix has no such entry, for each row and
    /// pair.
    std::vector<std::int32_t> fill_begin;
    std::vector<std::int32_t> fill;

    std::int32_t first_coupling() const { return upper_begin.back(); }
    std::int32_t first_constrained_edge() const {
        return first_coupling() + static_cast<std::int32_t>(couplings.size());
    }
    std::int32_t entry_count() const {
        return first_constrained_edge() + static_cast<std::int32_t>(constrained_edge_rows.size()) +
               1;
    }
};

/// Returns the pattern for a mesh that validate() accepts. With `lock_boundary`, the vertices of
/// the boundary are constrained.
CotangentPattern cotangent_pattern(const TriangleMesh& mesh, VertexOrder order, int block_count,
                                   bool lock_boundary);

}  // namespace tracked_mcf::benchmark
