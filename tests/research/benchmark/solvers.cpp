// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <Eigen/CholmodSupport>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/mesh/surface.h"
#include "filter_tracked_mcf/core/mesh/triangle_elements.h"
#include "filter_tracked_mcf/core/parallel/thread_team.h"
#include "tests/research/benchmark/meshes.h"
#include "tests/research/benchmark/rows.h"
#include "tests/research/benchmark/subcommands.h"
#include "tests/research/experiments/configuration.h"

namespace tracked_mcf::benchmark {

namespace {

using Points = Eigen::Matrix<double, Eigen::Dynamic, 3>;
using Matrix = Eigen::SparseMatrix<double>;
using IncompleteCholesky =
    Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>>;
using ConjugateGradients =
    Eigen::ConjugateGradient<Matrix, Eigen::Lower | Eigen::Upper, IncompleteCholesky>;

/// A solver's tolerance is this, halved until it reaches the error.
constexpr double kFirstTolerance = 0.1;
constexpr int kMostHalvings = 24;

struct Options {
    std::string mesh;
    std::string solver;
    double step_size = 5e-4;
    double error = 1e-3;  ///< of the displacement, in the energy norm, relative to it
};

/// The first step of the flow as one linear system, A d = b: vertices are numbered as in the
/// surface, lengths are edges. Rows of held vertices are those of the identity.
struct System {
    System(const TriangleMesh& mesh, const Options& options)
        : surface(surface_of(mesh, {}, BoundaryCondition::Locked)),
          a(surface.stars.count(), surface.stars.count()),
          b(Points::Zero(surface.stars.count(), 3)) {
        const double step = options.step_size / (surface.edge * surface.edge);
        const TriangleElements elements =
            elements_in_own_metric(surface.stars, surface.positions, {});
        std::vector<Eigen::Triplet<double>> entries;
        entries.reserve(9 * elements.size());
        const auto add = [&](std::int32_t row, std::int32_t column, double entry) {
            if (row != column && (surface.held[row] != 0 || surface.held[column] != 0)) return;
            entries.emplace_back(row, column, entry);
        };
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const Triangle& t = surface.stars.triangles[i];
            for (int k = 0; k < 3; ++k) {
                const std::int32_t p = t[(k + 1) % 3], q = t[(k + 2) % 3];
                const double mass = elements[i].mass, weight = step * elements[i].weights[k];
                // Half of the mass is lumped, half is consistent.
                add(t[k], t[k], 0.75 * mass);
                add(p, q, mass / 8 - weight);
                add(q, p, mass / 8 - weight);
                add(p, p, weight);
                add(q, q, weight);
                const Eigen::RowVector3d force =
                    weight * (surface.positions[q] - surface.positions[p]).transpose();
                b.row(p) += force;
                b.row(q) -= force;
            }
        }
        a.setFromTriplets(entries.begin(), entries.end());
        for (std::int32_t i = 0; i < surface.stars.count(); ++i) {
            if (surface.held[i] != 0) b.row(i).setZero();
        }
        exact = Eigen::CholmodSupernodalLLT<Matrix>(a).solve(b);
    }

    double energy_norm(const Points& x) const { return std::sqrt(x.cwiseProduct(a * x).sum()); }
    double error_of(const Points& d) const { return energy_norm(d - exact) / energy_norm(exact); }

    Surface surface;
    Matrix a;
    Points b, exact;
};

/// A solution, and how it was found.
struct Solution {
    Points displacement;
    Seconds seconds;
    Eigen::Index iterations = 0;
};

/// The time includes all of a step: elements, assembly, and what makes the step safe.
Solution solve_ours(const TriangleMesh& mesh, const System& system, const Options& options,
                    double tolerance) {
    FlowParameters parameters;
    parameters.step_size = options.step_size;
    parameters.order = 1;
    parameters.iterations = 1;
    parameters.tolerance = tolerance;
    const auto flow = experiments::make_flow(mesh, parameters);
    const ProcessStopwatch stopwatch;
    flow->step();
    Solution solution{Points(system.b.rows(), 3), stopwatch.seconds()};
    if (!flow->report().steps.empty())
        solution.iterations = flow->report().steps.back().solver_iterations;
    std::vector<Eigen::Vector3d> positions = mesh.positions;
    flow->move_vertices(positions);
    for (Eigen::Index i = 0; i < system.b.rows(); ++i) {
        const std::int32_t vertex = system.surface.mesh_vertices[i];
        solution.displacement.row(i) =
            (positions[vertex] - mesh.positions[vertex]).transpose() / system.surface.edge;
    }
    return solution;
}

/// The time is that of the factors and of the solution: the matrix, its order of elimination and
/// the pattern of the factor are there.
template <class Solver>
Solution solve_by(Solver& solver, const System& system) {
    solver.analyzePattern(system.a);
    const ProcessStopwatch stopwatch;
    solver.factorize(system.a);
    Solution solution;
    solution.displacement = solver.solve(system.b);
    solution.seconds = stopwatch.seconds();
    return solution;
}

Solution solve_by_conjugate_gradients(const System& system, double tolerance) {
    ConjugateGradients solver;
    solver.setTolerance(tolerance);
    Solution solution = solve_by(solver, system);
    solution.iterations = solver.iterations();
    return solution;
}

Solution solve_directly(const System& system) {
    Eigen::CholmodSupernodalLLT<Matrix> solver;
    return solve_by(solver, system);
}

void run(const Options& options) {
    const ThreadTeam threads(1);
    const TriangleMesh mesh = named_mesh(options.mesh);
    const System system(mesh, options);
    const std::map<std::string, std::function<Solution(double)>> solvers = {
        {"ours", [&](double t) { return solve_ours(mesh, system, options, t); }},
        {"IC(0)-CG", [&](double t) { return solve_by_conjugate_gradients(system, t); }},
        {"CHOLMOD", [&](double) { return solve_directly(system); }}};
    print_header();
    for (int halvings = 0; halvings <= kMostHalvings; ++halvings) {
        const double tolerance = std::ldexp(kFirstTolerance, -halvings);
        const Solution solution = solvers.at(options.solver)(tolerance);
        const double error = system.error_of(solution.displacement);
        if (!(error <= options.error)) continue;
        print_seconds("solver", 0, solution.seconds);
        if (solution.iterations > 0) {
            print_quantity("solver_iterations", 0, solution.iterations);
            print_quantity("solver_tolerance", 0, tolerance);
        }
        print_quantity("solver_error", 0, error);
        return;
    }
}

}  // namespace

void add_solvers(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "solvers", "Measures one step's system, solved to the same true error by each solver.");
    command->add_option("mesh", options->mesh)->required();
    command->add_option("solver", options->solver, "ours, IC(0)-CG or CHOLMOD")->required();
    command->add_option("--step-size", options->step_size);
    command->add_option("--error", options->error);
    command->callback([options] { run(*options); });
}

}  // namespace tracked_mcf::benchmark
