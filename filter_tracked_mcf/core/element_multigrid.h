#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "filter_tracked_mcf/core/coarse_solver.h"
#include "filter_tracked_mcf/core/element_blocks.h"
#include "filter_tracked_mcf/core/element_matrices.h"
#include "filter_tracked_mcf/core/element_partition.h"
#include "filter_tracked_mcf/core/element_smoother.h"
#include "filter_tracked_mcf/core/element_transfer.h"
#include "filter_tracked_mcf/core/field.h"
#include "filter_tracked_mcf/core/tracked_elements.h"

namespace tracked_mcf {

/// How much a V-cycle does.
enum class Effort {
    Usual,    ///< enough for most surfaces
    Thorough  ///< twice the smoothing, for the actual spectrum, on all levels: for what has pinched
};

/// The V-cycle that preconditions conjugate gradients: a few corrections by the ElementSmoother,
/// the coarse correction, and as many by the smoother. They are a Chebyshev iteration for the upper
/// part of the spectrum of S A, so from zero the V-cycle is a symmetric operator.
///
/// A coarse correction is for what the smoother hardly sees: where the stiffness outweighs the
/// mass. From one level to the next coarser one the ratio of the two falls to a quarter, so the
/// cycle ends where they are alike, with some more steps of the smoother.
///
/// No level's matrix A is assembled: everything goes by element matrices, of which a coarser
/// level's are the sums over its children (galerkin.h).
class ElementMultigrid {
public:
    /// `frozen`: for every level, coarsest first, which unknowns stay zero. `elements` must outlive
    /// this.
    ElementMultigrid(const TrackedElements& elements,
                     std::vector<std::vector<std::uint8_t>> frozen);
    ElementMultigrid(const ElementMultigrid&) = delete;
    ElementMultigrid& operator=(const ElementMultigrid&) = delete;

    /// Takes the finest level's element matrices, after setting the rows and columns of frozen
    /// unknowns to zero, and makes from them those of all levels that the cycle needs for
    /// `stiffness`, the ratio of stiffness to mass on the finest level: δ / h². They must stay
    /// until the next refresh.
    void refresh(MatrixBlocks& finest, double stiffness, Effort effort = Effort::Usual);

    /// From now on, thorough V-cycles are for spectra that are wider by half: for when the power
    /// method has missed the largest eigenvalue, and V-cycles are not positive.
    void widen() { margin_ *= 1.5; }

    /// The finest level's frozen unknowns; more may be frozen before a refresh.
    std::vector<std::uint8_t>& frozen() { return frozen_.back(); }

    /// Of every unknown of the finest level: whether it may move and something constrains it.
    const std::vector<std::uint8_t>& movable() const { return levels_.back().smoother.movable(); }

    /// x = one V-cycle from zero for A x = right_side on the finest level.
    void cycle(const Field& right_side, Field& x);

    /// product = A x on the finest level; returns x · A x.
    double multiply(const Field& x, Field& product) const;

    /// residual = right_side - A x on the finest level, computed in double.
    void residual(const Field& right_side, const Coefficients& x, Field& residual) const;

    /// The finest level's right side from those of its elements; zero where nothing may move.
    void assemble(const std::vector<ElementVector>& right_sides, Field& right_side) const;

private:
    struct LevelData {
        explicit LevelData(const Level& level);
        LevelData(const LevelData&) = delete;
        LevelData& operator=(const LevelData&) = delete;

        /// Makes the steps x += step * S residual, from x = 0.
        void smooth_from_zero(const Field& right_side, Field& x);
        /// residual = right_side - A x.
        void make_residual(const Field& right_side, const Field& x);

        const Level& level;
        ElementBlocks blocks;
        ElementPartition partition;
        ElementSmoother smoother;
        ElementTransfer transfer;  ///< from the next coarser level; unused at level 0
        const MatrixBlocks* matrices = nullptr;
        MatrixBlocks own_matrices;  ///< unused at the finest level
        std::vector<float> steps;   ///< of the smoother, on one side of the coarse correction
        Field residual;
        Field coarse_right_side, coarse_x;  ///< of the next coarser level; unused at level 0
    };

    void cycle(std::size_t level, const Field& right_side, Field& x);
    const LevelData& finest() const { return levels_.back(); }

    std::vector<std::vector<std::uint8_t>> frozen_;
    std::size_t coarsest_ = 0;  ///< level at which the cycle ends
    double margin_ = 1.2;       ///< by which eigenvalues may be larger than the power method says
    std::deque<LevelData> levels_;
    CoarseSolver coarse_solver_;
    std::vector<Couplings> couplings_;  ///< while refreshing
};

}  // namespace tracked_mcf
