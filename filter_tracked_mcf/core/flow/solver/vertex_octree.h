// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow/cells/bspline.h"
#include "filter_tracked_mcf/core/flow/octree/octree.h"
#include "filter_tracked_mcf/core/flow/solver/field.h"
#include "filter_tracked_mcf/core/flow/solver/mesh_system.h"
#include "filter_tracked_mcf/core/flow/system/matrix_blocks.h"
#include "filter_tracked_mcf/core/mesh/grid.h"
#include "filter_tracked_mcf/core/mesh/stars.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"
#include "filter_tracked_mcf/core/parallel/sorting.h"

namespace tracked_mcf {

/// The tracked octree of a surface's vertices: trilinear functions of the cells in which the
/// vertices were when it was built, as coarser functions of a mesh. An element is the set of a
/// cell's vertices that sides inside the cell connect, so that close sheets have functions of their
/// own.
///
/// P, the values of the finest level's functions at the vertices, never changes: the functions move
/// with the vertices.
class VertexOctree {
public:
    /// Puts vertices into the cells of a grid that encloses them: all of the parts for which
    /// `has_functions`, per vertex, is not 0; of all parts if it is empty.
    VertexOctree(const Stars& stars, const std::vector<Eigen::Vector3d>& positions,
                 const Grid& grid, const std::vector<std::uint8_t>& has_functions = {});

    const std::vector<Level>& levels() const { return levels_; }
    const Level& finest() const { return levels_.back(); }
    double cell_size() const { return cell_size_; }  ///< of the finest level
    /// Returns whether there are functions at a vertex.
    bool has_functions(std::int32_t vertex) const {
        return element_of_[vertex] < finest().element_count();
    }

    /// Sets the matrices of the finest elements to those of the system, as seen by the element's
    /// functions. Their sum is nearly PᵀAP: a triangle across cells counts in each by the share of
    /// its corners, with the cell's functions continued to the corners outside, and masses are
    /// lumped. So elements stay apart, and coarser levels follow from them as in the paper
    /// (section 5.2).
    void assemble(const MeshSystem& system, const TriangleElements& elements,
                  MatrixBlocks& matrices) const;

    /// Computes coarse = Pᵀ r; r is 0 at held vertices.
    void restrict(const Field& r, Field& coarse);
    /// Computes the rows of a block of x += P coarse, except for held vertices. Returns the product
    /// r · P coarse of these rows, which must have functions.
    double add_prolongated(const MeshSystem& system, const PartBlocks::Block& block,
                           const Field& coarse, const Field& r, Field& x) const;

private:
    /// One value for each function of an element.
    using Values = tracked_mcf::Values<float>;

    void find_elements(const Stars& stars, const std::vector<MortonCode>& cells, int depth,
                       const std::vector<std::uint8_t>& has_functions);
    /// Returns the values at a vertex of the functions of its own element.
    Values values_at(std::int32_t vertex) const;
    /// Returns the values at a vertex of the functions of an element, continued from its cell.
    Values values_at(std::int32_t vertex, std::int32_t element) const;

    double cell_size_;
    std::vector<Level> levels_;
    std::vector<std::int32_t> element_of_;  ///< per vertex; without functions, their number
    RawVector<Eigen::Vector3f> local_;      ///< per vertex, in the cell of its element
    Groups vertices_;                       ///< by element
    Field sums_;                            ///< workspace, eight columns per element
};

}  // namespace tracked_mcf
