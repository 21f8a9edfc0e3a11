// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/solver/element_multigrid.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/solver/level_products.h"
#include "filter_tracked_mcf/core/system/constrained_cells.h"

namespace tracked_mcf {

namespace {

/// Upper bound of the spectrum of S A, unless something has pinched.
constexpr double kLargest = 1.8;

/// Returns the optimal factors of `count` steps x += factor * S r for a spectrum from `smallest` to
/// `largest`: the reciprocals of the roots of the Chebyshev polynomial on that interval.
std::vector<float> chebyshev_steps(int count, double smallest, double largest) {
    const double pi = std::acos(-1.0);
    std::vector<float> steps;
    for (int i = 0; i < count; ++i) {
        const double root = 0.5 * (largest + smallest) +
                            0.5 * (largest - smallest) * std::cos(pi * (i + 0.5) / count);
        steps.push_back(static_cast<float>(1 / root));
    }
    return steps;
}

/// On a level whose stiffness is at most this times its mass, the smoother alone is faster.
constexpr double kStiff = 4;

}  // namespace

ElementMultigrid::LevelData::LevelData(const Level& of_level)
    : level(of_level),
      bricks(of_level),
      partition(of_level),
      smoother(of_level, bricks, partition) {}

ElementMultigrid::ElementMultigrid(const std::vector<Level>& levels,
                                   std::vector<std::vector<std::uint8_t>> constrained)
    : constrained_(std::move(constrained)), coarse_solver_(levels.front()) {
    for (const Level& level : levels) levels_.emplace_back(level);
    for (std::size_t l = 1; l < levels_.size(); ++l) {
        levels_[l].transfer = ElementTransfer(levels_[l].level, levels_[l - 1].level);
        levels_[l - 1].own_matrices.resize(levels_[l - 1].level.element_count());
    }
}

void ElementMultigrid::refresh(MatrixBlocks& finest, double stiffness_to_mass, Effort effort) {
    MatrixBlocks* matrices = &finest;
    for (coarsest_ = levels_.size() - 1;; --coarsest_, stiffness_to_mass /= 4) {
        LevelData& here = levels_[coarsest_];
        eliminate_constrained(here.level, constrained_[coarsest_], *matrices);
        here.matrices = matrices;
        if (coarsest_ == 0) break;
        here.smoother.refresh(*matrices, couplings_);
        // With a coarse correction, the smoother covers the upper part of the spectrum; on the
        // coarsest level of the cycle, it covers nearly all of it.
        if (effort == Effort::Thorough) {
            const double largest =
                std::max(kLargest, margin_ * here.smoother.largest_eigenvalue(*matrices));
            here.steps = chebyshev_steps(4, largest / 16, largest);
        } else if (stiffness_to_mass > kStiff) {
            here.steps = chebyshev_steps(2, kLargest / 6, kLargest);
        } else {
            here.steps = chebyshev_steps(3, kLargest / 12, kLargest);
            return;
        }
        matrices = &levels_[coarsest_ - 1].own_matrices;
        coarsen_element_matrices(here.level, here.transfer.children(), *here.matrices, *matrices);
    }
    coarse_solver_.factorise(*matrices);
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
    subtract_products(partition, *matrices, right_side, x, residual);
}

double ElementMultigrid::multiply(const Field& x, Field& product) const {
    return tracked_mcf::multiply(finest().partition, *finest().matrices, x, product);
}

void ElementMultigrid::residual(const Field& right_side, const Coefficients& x,
                                Field& residual) const {
    subtract_products(finest().level, *finest().matrices, right_side, x, residual);
}

void ElementMultigrid::assemble(const std::vector<ElementVector>& right_sides,
                                Field& right_side) const {
    sum_vectors(finest().partition, right_sides, right_side);
    parallel_for_rows(right_side.cols(), [&](std::int32_t unknown) {
        if (free_unknowns()[unknown] == 0) right_side.col(unknown).setZero();
    });
}

}  // namespace tracked_mcf
