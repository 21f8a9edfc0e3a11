#include "filter_tracked_mcf/core/step_solver.h"

#include <algorithm>
#include <utility>

#include "filter_tracked_mcf/core/conjugate_gradients.h"
#include "filter_tracked_mcf/core/element_multigrid.h"
#include "filter_tracked_mcf/core/locked_cells.h"
#include "filter_tracked_mcf/core/multigrid.h"
#include "filter_tracked_mcf/core/progress_meter.h"

namespace tracked_mcf {

namespace {

using Frozen = std::vector<std::vector<std::uint8_t>>;

/// Solver::Converged.
class ConvergedSolver : public StepSolver {
public:
    ConvergedSolver(const TrackedElements& elements, Frozen frozen, double tolerance)
        : multigrid_(elements, std::move(frozen)), tolerance_(tolerance) {}

    std::vector<std::uint8_t>& frozen() override { return multigrid_.frozen(); }

    void take(ElementSystems& systems, double step_size) override {
        if (first_area_ == 0) first_area_ = systems.area;
        // Of a surface that shrinks, the mass does and the stiffness does not.
        stiffness_ = systems.area > 0 ? step_size * first_area_ / systems.area : step_size;
        matrices_ = &systems.matrices;
        multigrid_.refresh(*matrices_, stiffness_, effort_);
        multigrid_.assemble(systems.right_sides, right_side_);
    }

    bool can_move() const override {
        const std::vector<std::uint8_t>& movable = multigrid_.movable();
        return std::any_of(movable.begin(), movable.end(), [](auto flag) { return flag != 0; });
    }

    void solve(Coefficients& solution, StepReport& report) override {
        report.residual_before = norm(right_side_);
        Convergence convergence;
        int made = 0;
        for (int tries = 1;; ++tries) {
            const int left = kMaximumSolverIterations - made;
            const bool last = tries == kMostTries;
            convergence = iterate(last ? left : std::min(left, worth_trying()), solution);
            made += convergence.iterations;
            if (last || convergence.reached_tolerance || made == kMaximumSolverIterations) break;
            // Where something pinches it will go on to, so this remains.
            if (effort_ == Effort::Thorough) multigrid_.widen();
            effort_ = Effort::Thorough;
            multigrid_.refresh(*matrices_, stiffness_, effort_);
        }
        report.solver_iterations = made;
        report.residual_after = convergence.residual;
        report.relative_residual = convergence.relative_error;
        report.reached_tolerance = convergence.reached_tolerance;
    }

private:
    Convergence iterate(int most, Coefficients& solution) {
        return conjugate_gradients_.solve(multigrid_, right_side_, tolerance_, most, solution);
    }

    /// Iterations after which a more careful V-cycle does better: for the default tolerance about
    /// twice what any surface needs that has not pinched, and more than most that have.
    int worth_trying() const { return effort_ == Effort::Usual ? 12 : 30; }

    /// Of V-cycles, each more careful than the one before.
    static constexpr int kMostTries = 5;

    ElementMultigrid multigrid_;
    ConjugateGradients conjugate_gradients_;
    double tolerance_;
    double first_area_ = 0;  ///< of the surface, grid units²
    double stiffness_ = 0;   ///< see ElementMultigrid::refresh
    Effort effort_ = Effort::Usual;
    MatrixBlocks* matrices_ = nullptr;
    Field right_side_;
};

/// Solver::OneWCycle.
class CycleSolver : public StepSolver {
public:
    CycleSolver(const TrackedElements& elements, Frozen frozen, int cycles)
        : multigrid_(elements, std::move(frozen)), cycles_(cycles) {}

    std::vector<std::uint8_t>& frozen() override { return multigrid_.frozen(); }

    void take(ElementSystems& systems, double /*step_size*/) override {
        multigrid_.refresh(systems.matrices);
        multigrid_.finest().assemble(systems.right_sides, right_side_);
    }

    bool can_move() const override {
        const std::vector<float>& inverse_diagonal = multigrid_.finest().inverse_diagonal();
        return std::any_of(inverse_diagonal.begin(), inverse_diagonal.end(),
                           [](float inverse) { return inverse != 0; });
    }

    void solve(Coefficients& solution, StepReport& report) override {
        set_zero(x_, right_side_.cols());
        report.residual_before = residual();
        for (int i = 0; i < cycles_; ++i) {
            multigrid_.cycle(right_side_, x_);
            advance_progress((i + 1.0) / cycles_);
        }
        report.residual_after = residual();
        report.solver_iterations = cycles_;
        solution = x_.topRows<3>().transpose().cast<double>();
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

Frozen frozen_unknowns(const TrackedElements& elements, BoundaryCondition boundary) {
    return boundary == BoundaryCondition::LockedCells ? unknowns_meeting_held_edges(elements)
                                                      : no_unknowns(elements);
}

}  // namespace

std::unique_ptr<StepSolver> make_step_solver(const TrackedElements& elements,
                                             const FlowParameters& parameters) {
    Frozen frozen = frozen_unknowns(elements, parameters.boundary);
    if (parameters.solver == Solver::OneWCycle) {
        return std::make_unique<CycleSolver>(elements, std::move(frozen), parameters.cycles);
    }
    return std::make_unique<ConvergedSolver>(elements, std::move(frozen), parameters.tolerance);
}

}  // namespace tracked_mcf
