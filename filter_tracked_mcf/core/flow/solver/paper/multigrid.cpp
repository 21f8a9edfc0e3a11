// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/paper/multigrid.h"

#include <utility>

#include "filter_tracked_mcf/core/flow/solver/element_transfer.h"
#include "filter_tracked_mcf/core/flow/system/constrained_cells.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// Gauss-Seidel sweeps before the coarse correction, and after it (section 5.2).
constexpr int kSweeps = 5;

/// A level with fewer unknowns may be visited thousands of times.
constexpr std::int32_t kCheapToVisit = 1000;

/// A level with at least this fraction of the next finer level's unknowns is hardly smaller.
constexpr double kHardlySmaller = 0.9;

}  // namespace

Multigrid::LevelData::LevelData(const TrackedElements& elements, std::size_t level)
    : matrix(elements.levels[level]), smoother(elements.levels[level]) {
    if (level > 0) {
        transfer = ElementTransfer(elements.levels[level], elements.levels[level - 1]);
        prolongation =
            tracked_mcf::prolongation(elements.levels[level], elements.levels[level - 1]);
        restriction = prolongation.transpose();
    }
}

Multigrid::Multigrid(const TrackedElements& elements,
                     std::vector<std::vector<std::uint8_t>> constrained)
    : elements_(elements),
      constrained_(std::move(constrained)),
      coarse_solver_(elements.levels.front()) {
    levels_.reserve(elements.levels.size());
    for (std::size_t level = 0; level < elements.levels.size(); ++level) {
        levels_.emplace_back(elements, level);
    }
}

void Multigrid::refresh(MatrixBlocks& finest) {
    MatrixBlocks* matrices = &finest;
    for (std::size_t level = levels_.size(); level-- > 0;) {
        eliminate_constrained(elements_.levels[level], constrained_[level], *matrices);
        levels_[level].matrix.assemble(*matrices, constrained_[level]);
        if (level == 0) break;
        MatrixBlocks& coarse = levels_[level - 1].element_matrices;
        levels_[level].transfer.coarsen(*matrices, coarse);
        matrices = &coarse;
    }
    coarse_solver_.factorise(*matrices);
}

void Multigrid::cycle(const Field& right_side, Field& x) {
    cycle(levels_.size() - 1, right_side, x);
}

void Multigrid::cycle(std::size_t level, const Field& right_side, Field& x) {
    LevelData& here = levels_[level];
    if (level == 0) {
        here.matrix.residual(right_side, x, here.residual);
        Field correction;
        coarse_solver_.solve(here.residual, correction);
        x += correction;
        return;
    }
    smooth(level, right_side, x);
    here.matrix.residual(right_side, x, here.residual);
    restrict_residual(level);
    LevelData& coarser = levels_[level - 1];
    set_zero(coarser.x, elements_.levels[level - 1].unknown_count());
    const int visits = worth_revisiting(level - 1) ? 2 : 1;
    for (int visit = 0; visit < visits; ++visit) {
        cycle(level - 1, coarser.right_side, coarser.x);
    }
    add_correction(level, x);
    smooth(level, right_side, x);
}

void Multigrid::smooth(std::size_t level, const Field& right_side, Field& x) const {
    const LevelData& here = levels_[level];
    for (int i = 0; i < kSweeps; ++i) here.smoother.sweep(here.matrix, right_side, x);
}

/// Returns whether a W-cycle visits a level twice. It visits a level that is hardly smaller than
/// the next finer one only once. Otherwise the work for a surface of many small components would
/// double at every level.
bool Multigrid::worth_revisiting(std::size_t level) const {
    const std::int32_t here = elements_.levels[level].unknown_count();
    const std::int32_t finer = elements_.levels[level + 1].unknown_count();
    return here < kCheapToVisit || here < kHardlySmaller * finer;
}

void Multigrid::restrict_residual(std::size_t level) {
    Field& coarse = levels_[level - 1].right_side;
    coarse.resize(4, elements_.levels[level - 1].unknown_count());
    parallel_for_rows(coarse.cols(), [&](std::int32_t row) {
        coarse.col(row) = row_times(levels_[level].restriction, row, levels_[level].residual);
    });
}

void Multigrid::add_correction(std::size_t level, Field& x) const {
    parallel_for_rows(x.cols(), [&](std::int32_t row) {
        // An unknown that is constrained, or whose support has collapsed, stays (section 5.1).
        if (levels_[level].matrix.inverse_diagonal()[row] == 0) return;
        x.col(row) += row_times(levels_[level].prolongation, row, levels_[level - 1].x);
    });
}

}  // namespace tracked_mcf
