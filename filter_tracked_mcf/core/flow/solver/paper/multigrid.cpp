// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/paper/multigrid.h"

#include <utility>

#include "filter_tracked_mcf/core/flow/system/constrained_cells.h"

namespace tracked_mcf {

namespace {

/// Gauss-Seidel sweeps before the coarse correction, and after it (section 5.2).
constexpr int kSweeps = 5;

/// A level with fewer unknowns may be visited thousands of times.
constexpr std::int32_t kCheapToVisit = 1000;

/// A level with at least this fraction of the next finer level's unknowns is hardly smaller.
constexpr double kHardlySmaller = 0.9;

}  // namespace

Multigrid::Multigrid(const TrackedElements& elements,
                     std::vector<std::vector<std::uint8_t>> constrained)
    : elements_(elements),
      constrained_(std::move(constrained)),
      coarse_solver_(elements.levels.front()) {
    levels_.reserve(elements.levels.size());
    for (std::size_t level = 0; level < elements.levels.size(); ++level) {
        levels_.emplace_back(elements.levels[level]);
        if (level > 0)
            levels_[level].transfer =
                ElementTransfer(elements.levels[level], elements.levels[level - 1]);
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
    LevelData& coarser = levels_[level - 1];
    here.transfer.restrict(here.residual, coarser.partition, coarser.right_side);
    set_zero(coarser.x, elements_.levels[level - 1].unknown_count());
    const int visits = worth_revisiting(level - 1) ? 2 : 1;
    for (int visit = 0; visit < visits; ++visit) {
        cycle(level - 1, coarser.right_side, coarser.x);
    }
    here.transfer.add_prolongated(coarser.x, here.matrix.free_unknowns(), x);
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

}  // namespace tracked_mcf
