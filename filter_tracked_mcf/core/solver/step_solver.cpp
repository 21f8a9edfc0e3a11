// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/solver/step_solver.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "filter_tracked_mcf/core/parallel/progress_meter.h"
#include "filter_tracked_mcf/core/solver/conjugate_gradients.h"
#include "filter_tracked_mcf/core/solver/element_multigrid.h"
#include "filter_tracked_mcf/core/solver/paper/multigrid.h"

namespace tracked_mcf {

namespace {

using ConstrainedByLevel = std::vector<std::vector<std::uint8_t>>;

/// Adds a solve's numbers to those of a step.
void add_solve(int iterations, double residual_before, double residual_after, StepReport& report) {
    report.solver_iterations += iterations;
    report.residual_before = std::hypot(report.residual_before, residual_before);
    report.residual_after = std::hypot(report.residual_after, residual_after);
}

/// Returns a power of two by which a right-hand side of this norm is divided. Conjugate gradients
/// square numbers, and single precision loses the squares of very small ones.
double unit_for(double norm) {
    constexpr double very_small = 1e-12, least = 1e-30;  // its inverse fits in a float
    return 0 < norm && norm < very_small ? std::exp2(std::ilogb(std::max(norm, least))) : 1;
}

/// Implements Solver::Grid.
class ConvergedSolver : public StepSolver {
public:
    ConvergedSolver(const TrackedElements& elements, ConstrainedByLevel constrained)
        : multigrid_(elements.levels, std::move(constrained)) {}

    void take(MatrixBlocks& matrices, const std::vector<std::uint8_t>& constrained,
              double stiffness_to_mass) override {
        matrices_ = &matrices;
        stiffness_to_mass_ = stiffness_to_mass;
        multigrid_.constrain(constrained);
        multigrid_.refresh(*matrices_, stiffness_to_mass_, effort_);
    }

    bool has_free_unknowns() const override {
        const std::vector<std::uint8_t>& free_unknowns = multigrid_.free_unknowns();
        return std::any_of(free_unknowns.begin(), free_unknowns.end(),
                           [](auto flag) { return flag != 0; });
    }

    void solve(const std::vector<ElementVector>& right_sides, double tolerance, Solution& solution,
               StepReport& report) override {
        multigrid_.assemble(right_sides, right_side_);
        const double size = norm(right_side_);
        const double unit = unit_for(size);
        right_side_ *= static_cast<float>(1 / unit);
        solution.x /= unit;
        Convergence convergence;
        int made = 0;
        for (int tries = 1;; ++tries) {
            const int left = kMaximumSolverIterations - made;
            const bool last = tries == kMostTries;
            const int most = last ? left : std::min(left, worth_trying());
            convergence = conjugate_gradients_.solve(multigrid_, right_side_, tolerance, most,
                                                     solution.x, solution.earlier_guess);
            made += convergence.iterations;
            if (last || convergence.reached_tolerance || made == kMaximumSolverIterations) break;
            // What has pinched stays pinched, so later steps keep this effort.
            if (effort_ == Effort::Thorough) multigrid_.widen();
            effort_ = Effort::Thorough;
            multigrid_.refresh(*matrices_, stiffness_to_mass_, effort_);
        }
        solution.x *= unit;
        add_solve(made, size, unit * convergence.residual, report);
        // Written so that a NaN is kept.
        if (!(convergence.error_estimate <= report.error_estimate)) {
            report.error_estimate = convergence.error_estimate;
        }
    }

private:
    /// Returns the number of iterations after which a V-cycle with more effort is faster. At the
    /// default tolerance, it is about twice what a surface without pinches needs.
    int worth_trying() const { return effort_ == Effort::Usual ? 12 : 30; }

    /// Number of attempts, each with a more thorough V-cycle than the one before.
    static constexpr int kMostTries = 5;

    ElementMultigrid multigrid_;
    ConjugateGradients conjugate_gradients_;
    double stiffness_to_mass_ = 0;  ///< see ElementMultigrid::refresh
    Effort effort_ = Effort::Usual;
    MatrixBlocks* matrices_ = nullptr;
    Field right_side_;
};

/// Implements Solver::OneWCycle.
class CycleSolver : public StepSolver {
public:
    CycleSolver(const TrackedElements& elements, ConstrainedByLevel constrained, int cycles)
        : multigrid_(elements, std::move(constrained)), cycles_(cycles) {}

    void take(MatrixBlocks& matrices, const std::vector<std::uint8_t>& constrained,
              double /*stiffness_to_mass*/) override {
        multigrid_.constrain(constrained);
        multigrid_.refresh(matrices);
    }

    bool has_free_unknowns() const override {
        const std::vector<float>& inverse_diagonal = multigrid_.finest().inverse_diagonal();
        return std::any_of(inverse_diagonal.begin(), inverse_diagonal.end(),
                           [](float inverse) { return inverse != 0; });
    }

    void solve(const std::vector<ElementVector>& right_sides, double /*tolerance*/,
               Solution& solution, StepReport& report) override {
        multigrid_.finest().assemble(right_sides, right_side_);
        set_zero(x_, right_side_.cols());
        const double residual_before = residual();
        for (int i = 0; i < cycles_; ++i) {
            multigrid_.cycle(right_side_, x_);
            advance_progress((i + 1.0) / cycles_);
        }
        add_solve(cycles_, residual_before, residual(), report);
        solution.x = x_.topRows<3>().transpose().cast<double>();
    }

private:
    double residual() {
        multigrid_.finest().residual(right_side_, x_, residual_);
        return norm(residual_);
    }

    Multigrid multigrid_;
    int cycles_;
    Field right_side_, x_, residual_;
};

}  // namespace

std::unique_ptr<StepSolver> make_step_solver(const TrackedElements& elements,
                                             ConstrainedByLevel constrained, int cycles) {
    if (cycles > 0) {
        return std::make_unique<CycleSolver>(elements, std::move(constrained), cycles);
    }
    return std::make_unique<ConvergedSolver>(elements, std::move(constrained));
}

}  // namespace tracked_mcf
