// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <deque>
#include <vector>

#include "filter_tracked_mcf/core/flow/solver/coarse_solver.h"
#include "filter_tracked_mcf/core/flow/solver/element_partition.h"
#include "filter_tracked_mcf/core/flow/solver/element_smoother.h"
#include "filter_tracked_mcf/core/flow/solver/element_transfer.h"
#include "filter_tracked_mcf/core/flow/solver/field.h"
#include "filter_tracked_mcf/core/flow/system/matrix_blocks.h"

namespace tracked_mcf {

/// The V-cycle that preconditions conjugate gradients. On each level, the ElementSmoother makes a
/// few corrections before the coarse correction and as many after it. They are a Chebyshev
/// iteration for the upper part of the spectrum of S A, so a V-cycle from zero is a symmetric
/// operator.
///
/// The coarse correction reduces errors that the smoother hardly reduces: those for which the
/// stiffness exceeds the mass. The ratio of stiffness to mass falls to a quarter from one level to
/// the next coarser one. The cycle ends at the level where they are similar, with some more
/// smoother steps.
///
/// No level's matrix A is assembled: all products use element matrices. Those of a coarser level
/// are sums over the children of each element (element_transfer.h).
class ElementMultigrid {
public:
    /// `levels`, coarsest first, must outlive this.
    explicit ElementMultigrid(const std::vector<Level>& levels);
    ElementMultigrid(const ElementMultigrid&) = delete;
    ElementMultigrid& operator=(const ElementMultigrid&) = delete;

    /// Takes the finest level's element matrices, and computes those of the coarser levels of the
    /// cycle. The matrices must stay valid until the next refresh. `stiffness_to_mass` is their
    /// ratio on the finest level, δ / h².
    void refresh(const MatrixBlocks& finest, double stiffness_to_mass);

    /// Doubles the spectrum of S A that the smoothers expect, after a V-cycle was not positive.
    /// Returns false, and changes nothing, if it is as wide as it may be.
    bool widen_spectrum();

    /// Computes x by one V-cycle from zero for A x = right_side on the finest level.
    void cycle(const Field& right_side, Field& x);

private:
    struct LevelData {
        explicit LevelData(const Level& of_level)
            : level(of_level), partition(of_level), smoother(of_level, partition) {}
        LevelData(const LevelData&) = delete;
        LevelData& operator=(const LevelData&) = delete;

        /// Makes the step x += step * S residual.
        void smooth(float step, const Field& right_side, Field& x);
        /// Computes residual = right_side - A x.
        void make_residual(const Field& right_side, const Field& x);

        const Level& level;
        ElementPartition partition;
        ElementSmoother smoother;
        ElementTransfer transfer;  ///< to and from the next coarser level; unused at level 0
        const MatrixBlocks* matrices = nullptr;
        MatrixBlocks own_matrices;  ///< unused at the finest level
        std::vector<float> steps;   ///< of the smoother, on one side of the coarse correction
        Field residual;
        Field coarse_right_side, coarse_x;  ///< of the next coarser level; unused at level 0
    };

    void cycle(std::size_t level, const Field& right_side, Field& x);

    double largest_;            ///< upper bound of the spectrum of S A
    std::size_t coarsest_ = 0;  ///< level at which the cycle ends
    std::deque<LevelData> levels_;
    CoarseSolver coarse_solver_;
};

}  // namespace tracked_mcf
