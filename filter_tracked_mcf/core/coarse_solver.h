#pragma once

#include <Eigen/Core>

#include "filter_tracked_mcf/core/level_matrix.h"

namespace tracked_mcf {

/// Solves the coarsest level directly. Its matrix may be singular, since its functions may be
/// dependent on the surface or locked; then the solution is that of least norm among the best ones.
class CoarseSolver {
public:
    void factorise(const LevelMatrix& matrix);

    /// x = A⁺ right_side over the unknowns that may move, zero for the others.
    void solve(const Field& right_side, Field& x) const;

private:
    Eigen::MatrixXd pseudo_inverse_;
};

}  // namespace tracked_mcf
