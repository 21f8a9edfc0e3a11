#include "filter_tracked_mcf/core/element_multigrid.h"

#include <utility>

#include "filter_tracked_mcf/core/element_products.h"
#include "filter_tracked_mcf/core/galerkin.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

namespace {

/// The part of the spectrum of S A in which the smoother is to be good: from a bit above the
/// largest eigenvalue down to a sixth of that. Coarse corrections see to the rest.
constexpr double kLargest = 1.8;
constexpr double kSmallest = 0.3;

/// The reciprocals of the roots of Chebyshev's polynomial of second degree on that interval, by
/// which two steps x += factor * S r are as good there as two can be.
constexpr double kCentre = (kLargest + kSmallest) / 2;
constexpr double kRadius = (kLargest - kSmallest) / 2;
constexpr double kHalfDiagonal = 0.70710678118654752;
constexpr auto kShortStep = static_cast<float>(1 / (kCentre + kRadius * kHalfDiagonal));
constexpr auto kLongStep = static_cast<float>(1 / (kCentre - kRadius * kHalfDiagonal));

}  // namespace

ElementMultigrid::LevelData::LevelData(const Level& of_level)
    : level(of_level),
      blocks(of_level),
      partition(of_level),
      smoother(of_level, blocks, partition) {}

ElementMultigrid::ElementMultigrid(const TrackedElements& elements,
                                   std::vector<std::vector<std::uint8_t>> frozen)
    : frozen_(std::move(frozen)), coarse_solver_(elements.levels.front()) {
    for (const Level& level : elements.levels) levels_.emplace_back(level);
    for (std::size_t l = 1; l < levels_.size(); ++l) {
        levels_[l].transfer = ElementTransfer(levels_[l].level, levels_[l - 1].level);
        resize(levels_[l - 1].own_matrices, levels_[l - 1].level.element_count());
    }
}

void ElementMultigrid::refresh(std::vector<ElementMatrix>& finest) {
    std::vector<ElementMatrix>* matrices = &finest;
    for (std::size_t l = levels_.size(); l-- > 0;) {
        LevelData& here = levels_[l];
        leave_out_frozen(here.level, frozen_[l], *matrices);
        here.matrices = matrices;
        if (l == 0) break;
        here.smoother.refresh(*matrices, couplings_);
        matrices = &levels_[l - 1].own_matrices;
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
    here.smoother.correct(kShortStep, right_side, x);
    here.make_residual(right_side, x);
    here.smoother.add_correction(kLongStep, here.residual, x);
    here.make_residual(right_side, x);
    here.transfer.restrict(here.residual, levels_[level - 1].partition, here.coarse_right_side);
    cycle(level - 1, here.coarse_right_side, here.coarse_x);
    here.transfer.add_prolongated(here.coarse_x, here.smoother.movable(), x);
    here.make_residual(right_side, x);
    here.smoother.add_correction(kLongStep, here.residual, x);
    here.make_residual(right_side, x);
    here.smoother.add_correction(kShortStep, here.residual, x);
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
        if (movable()[unknown] == 0) right_side.col(unknown).setZero();
    });
}

}  // namespace tracked_mcf
