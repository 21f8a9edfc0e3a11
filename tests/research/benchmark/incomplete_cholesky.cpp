// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <Eigen/IterativeLinearSolvers>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/platform/process_memory.h"
#include "tests/research/benchmark/meshes.h"
#include "tests/research/benchmark/rows.h"
#include "tests/research/benchmark/sphere_error.h"
#include "tests/research/benchmark/subcommands.h"

namespace tracked_mcf::benchmark {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3>;
using Matrix = Eigen::SparseMatrix<double>;

/// Thinner triangles are as stiff as one of this quality, 4√3 area / Σ edge². Otherwise conjugate
/// gradients hardly converge on scans with needles.
constexpr double kLeastQuality = 0.01;

struct Options {
    std::string mesh;
    double step_size = 5e-4;
    int steps = 4;
    double tolerance = 1e-6;  ///< of each coordinate's residual, relative to the right-hand side
    int most_iterations = 1000;
};

/// Dziuk's semi-implicit flow of a closed mesh, (M + δS) d = -δ S x, as in
/// tests/support/cotangent_flow.h, by Eigen's conjugate gradients with Eigen's incomplete Cholesky
/// factors without fill.
class IncompleteCholeskyFlow {
public:
    IncompleteCholeskyFlow(const TriangleMesh& mesh, const Options& options)
        : mesh_(mesh), options_(options), right_side_(size(), 3), displacement_(size(), 3) {
        std::vector<Eigen::Triplet<double>> entries;
        entries.reserve(9 * mesh.triangles.size() + mesh.positions.size());
        for (int i = 0; i < size(); ++i) entries.emplace_back(i, i, 0);
        for_each_entry([&](int row, int column) { entries.emplace_back(row, column, 0); });
        matrix_.resize(size(), size());
        matrix_.setFromTriplets(entries.begin(), entries.end());
        places_.reserve(9 * mesh.triangles.size());
        for_each_entry([&](int row, int column) {
            places_.push_back(&matrix_.coeffRef(row, column) - matrix_.valuePtr());
        });
        displacement_.setZero();
        solver_.setTolerance(options.tolerance);
        solver_.setMaxIterations(options.most_iterations);
        solver_.analyzePattern(matrix_);
    }

    void step(int number) {
        const ProcessStopwatch whole;
        assemble();
        print_quantity("assemble_seconds", number, whole.seconds().wall);
        const ProcessStopwatch factorizing;
        solver_.factorize(matrix_);
        print_quantity("factorize_seconds", number, factorizing.seconds().wall);
        const ProcessStopwatch solving;
        Eigen::Index iterations = 0;
        for (int axis = 0; axis < 3; ++axis) {
            displacement_.col(axis) =
                solver_.solveWithGuess(right_side_.col(axis), displacement_.col(axis)).eval();
            iterations = std::max(iterations, solver_.iterations());
        }
        for (int i = 0; i < size(); ++i) mesh_.positions[i] += displacement_.row(i).transpose();
        print_quantity("solve_seconds", number, solving.seconds().wall);
        print_seconds("step", number, whole.seconds());
        print_quantity("iterations", number, iterations);
    }

    const std::vector<Vector3d>& positions() const { return mesh_.positions; }

private:
    int size() const { return static_cast<int>(mesh_.positions.size()); }

    /// Calls visit(row, column) for the nine entries of each triangle.
    template <class Visit>
    void for_each_entry(const Visit& visit) const {
        for (const Triangle& t : mesh_.triangles) {
            for (const int row : t) {
                for (const int column : t) visit(row, column);
            }
        }
    }

    void assemble() {
        std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
        right_side_.setZero();
        auto place = places_.cbegin();
        for (const Triangle& t : mesh_.triangles) {
            Matrix3d sides;  // opposite to the corners
            for (int i = 0; i < 3; ++i) {
                sides.col(i) = mesh_.positions[t[(i + 2) % 3]] - mesh_.positions[t[(i + 1) % 3]];
            }
            const Vector3d normal = sides.col(0).cross(sides.col(1));
            const double area = 0.5 * normal.norm();
            const double least_area = kLeastQuality * sides.squaredNorm() / (4 * std::sqrt(3.0));
            const double stiffness =
                options_.step_size / (4 * std::max({area, least_area, 1e-300}));
            const Matrix3d element = area / 12 * (Matrix3d::Ones() + Matrix3d::Identity()) +
                                     stiffness * (sides.transpose() * sides);
            for (int i = 0; i < 3; ++i) {
                // S x is n × side / 2.
                right_side_.row(t[i]) -=
                    0.5 * options_.step_size * normal.normalized().cross(sides.col(i)).transpose();
                for (int j = 0; j < 3; ++j) matrix_.valuePtr()[*place++] += element(i, j);
            }
        }
    }

    TriangleMesh mesh_;
    Options options_;
    Matrix matrix_;
    std::vector<std::ptrdiff_t> places_;  ///< of each triangle's nine entries in the matrix
    Points right_side_, displacement_;
    Eigen::ConjugateGradient<
        Matrix, Eigen::Lower | Eigen::Upper,
        Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>>>
        solver_;
};

void run(const Options& options) {
    const TriangleMesh mesh = named_mesh(options.mesh);
    print_header();
    const ProcessStopwatch stopwatch;
    IncompleteCholeskyFlow flow(mesh, options);
    print_seconds("setup", 0, stopwatch.seconds());
    print_quantity("vertices", 0, mesh.positions.size());
    for (int number = 1; number <= options.steps; ++number) flow.step(number);
    print_quantity("peak_memory_bytes", 0, peak_memory_bytes());
    print_sphere_error(options.mesh, flow.positions(), options.step_size, options.steps);
}

}  // namespace

void add_incomplete_cholesky(CLI::App& app) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand(
        "incomplete-cholesky",
        "Measures the cotangent flow by Eigen's conjugate gradients with an incomplete Cholesky "
        "factorisation.");
    command->add_option("mesh", options->mesh)->required();
    command->add_option("--step-size", options->step_size);
    command->add_option("--steps", options->steps)->check(CLI::PositiveNumber);
    command->add_option("--tolerance", options->tolerance);
    command->add_option("--most-iterations", options->most_iterations);
    command->callback([options] { run(*options); });
}

}  // namespace tracked_mcf::benchmark
