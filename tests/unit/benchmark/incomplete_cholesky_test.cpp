// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the benchmark's peer with the same flow solved by factorisation.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/flow/cells/grid.h"
#include "tests/research/benchmark/incomplete_cholesky_flow.h"
#include "tests/support/cotangent_flow.h"
#include "tests/support/shapes.h"

namespace tracked_mcf::benchmark {
namespace {

using Eigen::Vector3d;

struct Difference {
    double worst = 0;         ///< largest distance of a vertex
    double displacement = 0;  ///< largest displacement of a vertex
};

/// Compares both flows after two steps.
Difference difference(const TriangleMesh& mesh, const IncompleteCholeskyParameters& parameters) {
    const double side = longest_side(mesh);
    CotangentFlow factorised(mesh, parameters.step_size / (side * side), parameters.boundary);
    IncompleteCholeskyFlow iterated(mesh, parameters);
    for (int i = 0; i < 2; ++i) {
        factorised.step();
        EXPECT_LE(iterated.step().relative_residual, parameters.tolerance);
    }
    const std::vector<Vector3d> positions = iterated.positions();
    Difference result;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vector3d& expected = factorised.mesh().positions[i];
        result.worst = std::max(result.worst, (positions[i] - expected).norm());
        result.displacement = std::max(result.displacement, (expected - mesh.positions[i]).norm());
    }
    return result;
}

void expect_same(const TriangleMesh& mesh, const IncompleteCholeskyParameters& parameters) {
    const Difference d = difference(mesh, parameters);
    EXPECT_LT(d.worst, 1e-5 * d.displacement)
        << "δ = " << parameters.step_size << ", " << parameters.threads << " blocks, relaxation "
        << parameters.relaxation;
}

TEST(IncompleteCholesky, MatchesTheFactorisedFlow) {
    const TriangleMesh mesh = shapes::bumpy_sphere(24);
    for (const double step_size : {1e-4, 1e-2}) {
        for (const VertexOrder order :
             {VertexOrder::AsGiven, VertexOrder::ReverseCuthillMcKee, VertexOrder::Morton}) {
            IncompleteCholeskyParameters parameters;
            parameters.step_size = step_size;
            parameters.order = order;
            expect_same(mesh, parameters);
        }
    }
}

TEST(IncompleteCholesky, MatchesWithSeveralBlocksAndRelaxation) {
    for (const int threads : {2, 5}) {
        IncompleteCholeskyParameters parameters;
        parameters.step_size = 1e-2;
        parameters.threads = threads;
        parameters.relaxation = 0.97;
        expect_same(shapes::bumpy_sphere(24), parameters);
    }
}

TEST(IncompleteCholesky, KeepsALockedBoundary) {
    const TriangleMesh tube = shapes::tube(60, 40, 1.5);
    for (const BoundaryCondition boundary : {BoundaryCondition::Locked, BoundaryCondition::Free}) {
        for (const int threads : {1, 2}) {
            IncompleteCholeskyParameters parameters;
            parameters.step_size = 1e-3;
            parameters.boundary = boundary;
            parameters.threads = threads;
            expect_same(tube, parameters);
        }
    }
}

TEST(IncompleteCholesky, WarmStartSavesIterations) {
    IncompleteCholeskyParameters parameters;
    parameters.step_size = 1e-3;
    IncompleteCholeskyFlow warm(shapes::bumpy_sphere(24), parameters);
    parameters.warm_start = false;
    IncompleteCholeskyFlow cold(shapes::bumpy_sphere(24), parameters);
    int saved = 0;
    for (int i = 0; i < 3; ++i) saved += cold.step().iterations - warm.step().iterations;
    EXPECT_GT(saved, 0);
}

}  // namespace
}  // namespace tracked_mcf::benchmark
