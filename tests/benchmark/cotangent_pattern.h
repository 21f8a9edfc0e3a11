#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/triangle_mesh.h"
#include "tests/benchmark/triangle_places.h"
#include "tests/benchmark/vertex_order.h"

namespace tracked_mcf::benchmark {

/// An edge between two unknowns of different blocks.
struct Coupling {
    std::int32_t row;
    std::int32_t column;
};

/// What of the cotangent flow's matrix never changes: the numbering of its rows, where its entries
/// are, and where each triangle adds to them.
///
/// The symmetric matrix is cut into as many diagonal blocks of consecutive rows as there are
/// threads. It has an entry for every edge of the mesh: first those inside the blocks, by rows and
/// columns of the upper triangle; then the couplings; then the edges between an unknown and a held
/// vertex; and one for all edges between held vertices, which nobody reads.
struct CotangentPattern {
    static constexpr std::int32_t kNone = -1;

    std::int32_t vertex_count = 0;
    std::int32_t unknown_count = 0;          ///< held vertices are numbered after them
    std::vector<std::int32_t> number;        ///< of every vertex of the mesh
    std::vector<std::int32_t> block_begin;   ///< rows of every block, and the end
    std::vector<std::int32_t> upper_begin;   ///< entries right of the diagonal of every row
    std::vector<std::int32_t> upper_column;  ///< of these
    std::vector<std::int32_t> lower_begin;   ///< the same left of the diagonal
    std::vector<std::int32_t> lower_column;
    std::vector<std::int32_t>
        lower_place;  ///< of every entry of the upper triangle: the same below
    std::vector<Coupling> couplings;
    std::vector<std::int32_t> held_edge_rows;
    std::vector<TrianglePlaces> triangles;
    std::vector<std::int64_t> triangle_begin;  ///< of every block; then those of several; the end

    /// Eliminating a row changes the entries between any two of its upper columns: row by row, and
    /// pair (a, b) by pair, a < b, which entry that is, or kNone if the matrix does not have it.
    std::vector<std::int32_t> fill_begin;
    std::vector<std::int32_t> fill;

    std::int32_t first_coupling() const { return upper_begin.back(); }
    std::int32_t first_held_edge() const {
        return first_coupling() + static_cast<std::int32_t>(couplings.size());
    }
    std::int32_t entry_count() const {
        return first_held_edge() + static_cast<std::int32_t>(held_edge_rows.size()) + 1;
    }
};

/// The pattern for a mesh that validate() accepts; the vertices of edges of one triangle only are
/// held if so asked.
CotangentPattern cotangent_pattern(const TriangleMesh& mesh, VertexOrder order, int block_count,
                                   bool hold_boundary);

}  // namespace tracked_mcf::benchmark
