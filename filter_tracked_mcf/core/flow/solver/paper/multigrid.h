// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow/elements/tracked_elements.h"
#include "filter_tracked_mcf/core/flow/solver/coarse_solver.h"
#include "filter_tracked_mcf/core/flow/solver/element_partition.h"
#include "filter_tracked_mcf/core/flow/solver/element_transfer.h"
#include "filter_tracked_mcf/core/flow/solver/paper/gauss_seidel.h"
#include "filter_tracked_mcf/core/flow/solver/paper/level_matrix.h"
#include "filter_tracked_mcf/core/flow/system/matrix_blocks.h"

namespace tracked_mcf {

/// The paper's multigrid solver (section 5.2): W-cycles with Gauss-Seidel smoothing on assembled
/// matrices. Patterns, transfers and the order of the smoother are made once; refresh() sets the
/// values whenever the metric has changed.
class Multigrid {
public:
    /// `constrained` are the flags of the constrained unknowns of each level, coarsest first.
    /// `elements` must outlive this.
    Multigrid(const TrackedElements& elements, std::vector<std::vector<std::uint8_t>> constrained);
    Multigrid(const Multigrid&) = delete;
    Multigrid& operator=(const Multigrid&) = delete;

    /// Takes the finest level's element matrices, sets the rows and columns of constrained unknowns
    /// to zero in them, and computes every level's matrix.
    void refresh(MatrixBlocks& finest);

    /// Improves x, an approximate solution of A x = right_side on the finest level, by one W-cycle.
    void cycle(const Field& right_side, Field& x);

    const LevelMatrix& finest() const { return levels_.back().matrix; }
    const LevelMatrix& matrix(int level) const { return levels_[level].matrix; }

private:
    struct LevelData {
        explicit LevelData(const Level& level) : matrix(level), smoother(level), partition(level) {}

        LevelMatrix matrix;
        GaussSeidel smoother;
        ElementPartition partition;
        ElementTransfer transfer;       ///< to and from the next coarser level; empty at level 0
        MatrixBlocks element_matrices;  ///< unused at the finest level
        Field right_side, x, residual;  ///< the coarse problem of a cycle
    };

    void cycle(std::size_t level, const Field& right_side, Field& x);
    void smooth(std::size_t level, const Field& right_side, Field& x) const;
    bool worth_revisiting(std::size_t level) const;

    const TrackedElements& elements_;
    std::vector<std::vector<std::uint8_t>> constrained_;
    std::vector<LevelData> levels_;
    CoarseSolver coarse_solver_;
};

}  // namespace tracked_mcf
