#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/coarse_solver.h"
#include "filter_tracked_mcf/core/gauss_seidel.h"
#include "filter_tracked_mcf/core/level_matrix.h"
#include "filter_tracked_mcf/core/matrix_blocks.h"
#include "filter_tracked_mcf/core/tracked_elements.h"
#include "filter_tracked_mcf/core/transfer.h"

namespace tracked_mcf {

/// What a cycle does; the default is the paper's (section 5.2).
struct CycleParameters {
    int sweeps_before = 5;  ///< before the coarse correction
    int sweeps_after = 5;   ///< and after it
    /// Times a level visits the next coarser one: 1 is a V-, 2 a W-cycle. One that is hardly
    /// smaller is visited once, or the work for a surface in many small parts would double at every
    /// level.
    int coarse_visits = 2;
};

/// The paper's multigrid solver over the levels of tracked elements, smoothed by Gauss-Seidel over
/// the unknowns. Patterns, transfers and the order of
/// the smoother are made once; the numbers are refreshed whenever the metric has changed.
class Multigrid {
public:
    /// `frozen`: for every level, coarsest first, which unknowns stay zero. `elements` must outlive
    /// this.
    Multigrid(const TrackedElements& elements, std::vector<std::vector<std::uint8_t>> frozen,
              const CycleParameters& parameters = {});
    Multigrid(const Multigrid&) = delete;
    Multigrid& operator=(const Multigrid&) = delete;

    /// Takes the finest level's element matrices, after setting the rows and columns of frozen
    /// unknowns to zero, and makes every level's matrix from them.
    void refresh(MatrixBlocks& finest);

    /// The finest level's frozen unknowns; more may be frozen before a refresh.
    std::vector<std::uint8_t>& frozen() { return frozen_.back(); }

    /// Improves x, a solution of A x = right_side on the finest level, by one cycle.
    void cycle(const Field& right_side, Field& x);

    const LevelMatrix& finest() const { return levels_.back().matrix; }
    const LevelMatrix& matrix(int level) const { return levels_[level].matrix; }
    const SparseMatrix& prolongation(int level) const { return levels_[level].prolongation; }

private:
    struct LevelData {
        LevelData(const TrackedElements& elements, std::size_t level);

        LevelMatrix matrix;
        GaussSeidel smoother;
        Groups children;                ///< of this level's elements, in the next finer one
        SparseMatrix prolongation;      ///< from the next coarser level; empty at level 0
        SparseMatrix restriction;       ///< its transpose
        MatrixBlocks element_matrices;  ///< unused at the finest level
        Field right_side, x, residual;  ///< the coarse problem of a cycle
    };

    void cycle(std::size_t level, const Field& right_side, Field& x);
    bool worth_revisiting(std::size_t level) const;
    void restrict_residual(std::size_t level);
    void add_correction(std::size_t level, Field& x) const;

    const TrackedElements& elements_;
    CycleParameters parameters_;
    std::vector<std::vector<std::uint8_t>> frozen_;
    std::vector<LevelData> levels_;
    CoarseSolver coarse_solver_;
};

}  // namespace tracked_mcf
