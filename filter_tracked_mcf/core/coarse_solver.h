#pragma once

#include <Eigen/Core>
#include <vector>

#include "filter_tracked_mcf/core/field.h"
#include "filter_tracked_mcf/core/matrix_blocks.h"
#include "filter_tracked_mcf/core/octree.h"

namespace tracked_mcf {

/// Solves the coarsest level directly. There an element is all of the surface, or all of one of its
/// connected parts, so no two elements have an unknown in common and each is solved by itself.
///
/// An element's matrix may be singular, since its functions may be dependent on the surface or
/// locked; then the solution is that of least norm among the best ones.
class CoarseSolver {
public:
    /// `level` is level 0; it must outlive this.
    explicit CoarseSolver(const Level& level) : level_(level) {}

    /// Takes the element matrices of the level, in which the rows and columns of unknowns that may
    /// not move are zero.
    void factorise(const MatrixBlocks& matrices);

    /// x = A⁺ right_side over the unknowns that may move, zero for the others.
    void solve(const Field& right_side, Field& x) const;

private:
    const Level& level_;
    std::vector<Eigen::MatrixXd> pseudo_inverses_;  ///< 8 by 8, of every element
};

}  // namespace tracked_mcf
