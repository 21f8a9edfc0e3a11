// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/element_multigrid.h"

#include <cmath>

#include "filter_tracked_mcf/core/pi.h"

namespace tracked_mcf {

namespace {

/// Upper bound of the spectrum of S A on most surfaces, and where sheets share functions.
constexpr double kUsuallyLargest = 1.8, kLargestOfSheets = 4 * kUsuallyLargest;

/// Returns the optimal factors of `count` steps x += factor * S r for a spectrum from `smallest` to
/// `largest`: the reciprocals of the roots of the Chebyshev polynomial on that interval.
std::vector<float> chebyshev_steps(int count, double smallest, double largest) {
    std::vector<float> steps;
    for (int i = 0; i < count; ++i) {
        const double root = 0.5 * (largest + smallest) +
                            0.5 * (largest - smallest) * std::cos(kPi * (i + 0.5) / count);
        steps.push_back(static_cast<float>(1 / root));
    }
    return steps;
}

/// On a level whose stiffness is at most this times its mass, the smoother alone is faster.
constexpr double kStiff = 4;

}  // namespace

ElementMultigrid::ElementMultigrid(const std::vector<Level>& levels)
    : largest_(kUsuallyLargest), coarse_solver_(levels.front()) {
    for (const Level& level : levels) levels_.emplace_back(level);
    for (std::size_t l = 1; l < levels_.size(); ++l) {
        levels_[l].transfer = ElementTransfer(levels_[l].level, levels_[l - 1].level);
    }
}

void ElementMultigrid::refresh(const MatrixBlocks& finest, double stiffness_to_mass) {
    const MatrixBlocks* matrices = &finest;
    for (coarsest_ = levels_.size() - 1;; --coarsest_, stiffness_to_mass /= 4) {
        LevelData& here = levels_[coarsest_];
        here.matrices = matrices;
        if (coarsest_ == 0) break;
        here.smoother.refresh(*matrices);
        // With a coarse correction, the smoother covers the upper part of the spectrum; on the
        // coarsest level of the cycle, it covers nearly all of it.
        if (stiffness_to_mass > kStiff) {
            here.steps = chebyshev_steps(2, largest_ / 6, largest_);
        } else {
            here.steps = chebyshev_steps(3, largest_ / 12, largest_);
            return;
        }
        MatrixBlocks& coarser = levels_[coarsest_ - 1].own_matrices;
        here.transfer.coarsen(*matrices, coarser);
        matrices = &coarser;
    }
    coarse_solver_.factorise(*matrices);
}

bool ElementMultigrid::widen_spectrum() {
    if (largest_ >= kLargestOfSheets) return false;
    largest_ *= 2;
    for (LevelData& level : levels_) {
        for (float& step : level.steps) step /= 2;
    }
    return true;
}

void ElementMultigrid::cycle(const Field& right_side, Field& x) {
    cycle(levels_.size() - 1, right_side, x);
}

void ElementMultigrid::cycle(std::size_t level, const Field& right_side, Field& x) {
    if (level == 0) {
        coarse_solver_.solve(right_side, x);
        return;
    }
    LevelData& here = levels_[level];
    here.smoother.correct(nullptr, here.steps.front(), right_side, x);
    for (std::size_t i = 1; i < here.steps.size(); ++i) here.smooth(here.steps[i], right_side, x);
    if (level == coarsest_) return;
    here.make_residual(right_side, x);
    here.transfer.restrict(here.residual, levels_[level - 1].partition, here.coarse_right_side);
    cycle(level - 1, here.coarse_right_side, here.coarse_x);
    here.transfer.add_prolongated(here.coarse_x, here.smoother.free_unknowns(), x);
    for (auto step = here.steps.rbegin(); step != here.steps.rend(); ++step) {
        here.smooth(*step, right_side, x);
    }
}

void ElementMultigrid::LevelData::smooth(float step, const Field& right_side, Field& x) {
    make_residual(right_side, x);
    smoother.correct(&x, step, residual, x);
}

void ElementMultigrid::LevelData::make_residual(const Field& right_side, const Field& x) {
    partition.add_products(*matrices, -1, x, &right_side, residual);
}

}  // namespace tracked_mcf
