// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "filter_tracked_mcf/core/flow/octree/octree.h"
#include "filter_tracked_mcf/core/flow/solver/field.h"
#include "filter_tracked_mcf/core/flow/system/matrix_blocks.h"

namespace tracked_mcf {

/// Solves the coarsest level directly. Each of its elements is a whole connected component of the
/// surface, or the whole surface if sheets are not separated. So no two elements share an unknown,
/// and each element is solved on its own.
///
/// An element's matrix may be singular, because its functions may be dependent on the surface or
/// constrained. The solution is then the least-squares solution of least norm.
class CoarseSolver {
public:
    /// `level` is level 0; it must outlive this.
    explicit CoarseSolver(const Level& level) : level_(level) {}

    /// Takes the level's element matrices, with zero rows and columns for constrained unknowns.
    void factorise(const MatrixBlocks& matrices);

    /// Computes x = A⁺ right_side; constrained unknowns are zero.
    void solve(const Field& right_side, Field& x) const;

private:
    const Level& level_;
    std::vector<Eigen::Matrix<double, 8, 8>> pseudo_inverses_;  ///< of each element
};

}  // namespace tracked_mcf
