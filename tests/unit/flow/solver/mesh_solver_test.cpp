// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/mesh_solver.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cfenv>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "filter_tracked_mcf/core/parallel/thread_team.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"
#include "tests/unit/mesh_system.h"

namespace tracked_mcf {
namespace {

using Vertices = std::vector<Eigen::Vector3d>;

/// A surface and the solver of its systems.
struct SolverOfMesh {
    /// A depth of 0 is no octree.
    SolverOfMesh(const TriangleMesh& mesh, int depth, double step_size,
                 BoundaryCondition boundary = BoundaryCondition::Free)
        : SolverOfMesh(surface_of(mesh, {}, boundary), step_size, depth) {}
    SolverOfMesh(Surface of_surface, double step_size, int depth = 0)
        : surface(std::move(of_surface)),
          elements(elements_of(surface)),
          solver(surface.stars, surface.held, surface.parts),
          step(step_size) {
        if (depth > 0) {
            solver.use(std::make_unique<VertexOctree>(surface.stars, surface.positions,
                                                      grid_around(surface.positions, depth)));
        }
        solver.take(elements, step);
    }
    SolverOfMesh(const SolverOfMesh&) = delete;
    SolverOfMesh& operator=(const SolverOfMesh&) = delete;

    /// Returns the right-hand side of a step of the flow.
    Field flow() const {
        Field b;
        solver.system().multiply_stiffness(surface.positions, -1, b);
        return b;
    }
    /// Returns A with rows and columns of the identity at vertices that stay.
    Eigen::MatrixXd dense() const {
        Eigen::MatrixXd a =
            dense_mass(surface.stars, elements) + step * dense_stiffness(surface.stars, elements);
        for (std::int32_t i = 0; i < surface.stars.count(); ++i) {
            if (surface.held[i] == 0) continue;
            a.row(i).setZero();
            a.col(i).setZero();
            a(i, i) = 1;
        }
        return a;
    }

    Surface surface;
    TriangleElements elements;
    MeshSolver solver;
    double step;
};

double energy_norm(const Eigen::MatrixXd& a, const Eigen::MatrixXd& x) {
    return std::sqrt(x.cwiseProduct(a * x).sum());
}

TEST(MeshSolver, ComputesWithoutNumbersThatAreAlmostLost) {
    // Almost all of a surface is smooth but for rounding. The squares of it are numbers for which
    // processors take a hundred times as long.
    SolverOfMesh of(shapes::transformed(shapes::square(20), Eigen::Affine3d(Eigen::Scaling(20.0))),
                    0, 0.1);
    Field b = 1e-16F * random_at_vertices(of.surface, 1);
    b.col(0).head<3>().setOnes();
    Vertices x;
    std::feclearexcept(FE_UNDERFLOW);
    of.solver.solve(b, 1e-3, x);
    EXPECT_EQ(std::fetestexcept(FE_UNDERFLOW), 0);
}

TEST(MeshSolver, SolvesToTheTolerance) {
    for (const auto boundary : {BoundaryCondition::Free, BoundaryCondition::Locked}) {
        for (const double step : {0.1, 10.0, 1000.0}) {
            for (const int depth : {0, 3}) {
                SolverOfMesh of(noisy(bumpy_cap(14), 0.005), depth, step, boundary);
                const Eigen::MatrixXd a = of.dense();
                const Eigen::LLT<Eigen::MatrixXd> cholesky(a);
                // The solver's matrix is rounded to single precision.
                const double rounding = 5e-9 * step;
                for (const Field& b : {of.flow(), random_at_vertices(of.surface, 1)}) {
                    const Eigen::MatrixXd exact = cholesky.solve(rows_of(b));
                    for (const double tolerance : {1e-1, 1e-3, 1e-6}) {
                        Vertices x;
                        const MeshConvergence result = of.solver.solve(b, tolerance, x);
                        EXPECT_LE(result.error_estimate, tolerance);
                        EXPECT_GT(result.iterations, 0);
                        const double error =
                            energy_norm(a, rows_of(x) - exact) / energy_norm(a, exact);
                        EXPECT_LE(error, 3 * tolerance + rounding)
                            << step << ' ' << depth << ' ' << tolerance;
                    }
                }
            }
        }
    }
}

TEST(MeshSolver, ReportsTheResidual) {
    SolverOfMesh of(bumpy_cap(14), 3, 10, BoundaryCondition::Locked);
    const Field b = of.flow();
    Vertices x;
    const MeshConvergence result = of.solver.solve(b, 1e-3, x);
    EXPECT_NEAR(result.residual_before, norm(b), 1e-12 * norm(b));
    EXPECT_NEAR(result.residual_after, (rows_of(b) - of.dense() * rows_of(x)).norm(),
                1e-6 * norm(b));
}

TEST(MeshSolver, KeepsVerticesThatStay) {
    for (const int depth : {0, 3}) {
        SolverOfMesh of(bumpy_cap(14), depth, 100, BoundaryCondition::Locked);
        Vertices x;
        of.solver.solve(random_at_vertices(of.surface, 1), 1e-3, x);
        for (std::int32_t i = 0; i < of.surface.stars.count(); ++i) {
            EXPECT_EQ(x[i].isZero(0), of.surface.held[i] != 0);
        }
    }
}

TEST(MeshSolver, SolvesNothingInNoIteration) {
    for (const int depth : {0, 3}) {
        SolverOfMesh of(bumpy_cap(14), depth, 100);
        Vertices x(3, Eigen::Vector3d(1, 2, 3));
        const MeshConvergence result =
            of.solver.solve(Field::Zero(4, of.surface.stars.count()), 1e-3, x);
        EXPECT_EQ(result.iterations, 0);
        EXPECT_EQ(result.error_estimate, 0);
        ASSERT_EQ(x.size(), of.surface.positions.size());
        for (const Eigen::Vector3d& d : x) EXPECT_TRUE(d.isZero(0));
    }
}

TEST(MeshSolver, AnOctreeTakesFewIterationsForLongWaves) {
    for (const double step : {100.0, 1e4}) {
        SolverOfMesh with(shapes::bumpy_sphere(40), 4, step),
            without(shapes::bumpy_sphere(40), 0, step);
        const Field b = random_at_vertices(with.surface, 1);
        Vertices x;
        const int few = with.solver.solve(b, 1e-3, x).iterations;
        const int many = without.solver.solve(b, 1e-3, x).iterations;
        EXPECT_LE(few, 12) << step;
        EXPECT_GE(many, (step > 1000 ? 12 : 3) * few) << step;
    }
}

TEST(MeshSolver, WidensTheSpectrumWhereSheetsShareFunctions) {
    // Cells in which flat pieces meet at many angles.
    TriangleMesh rough = shapes::square(39);
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    for (Eigen::Vector3d& position : rough.positions) position.z() += 4.0 / 39 * normal(random);
    SolverOfMesh of(shapes::split_in_four(rough), 3, 1e4, BoundaryCondition::Locked);
    Vertices x;
    const MeshConvergence result = of.solver.solve(of.flow(), 1e-3, x);
    EXPECT_LE(result.error_estimate, 1e-3);
    EXPECT_NE(of.solver.octree(), nullptr);
}

TEST(MeshSolver, GoesOnWithoutAnOctreeThatDoesNotHelp) {
    // The functions of an octree of other places jump from vertex to vertex.
    SolverOfMesh with(shapes::bumpy_sphere(14), 3, 1e4), without(shapes::bumpy_sphere(14), 0, 1e4);
    Vertices shuffled = with.surface.positions;
    std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(1));
    with.solver.use(
        std::make_unique<VertexOctree>(with.surface.stars, shuffled, grid_around(shuffled, 3)));
    with.solver.take(with.elements, with.step);
    Vertices x, expected;
    const MeshConvergence result = with.solver.solve(with.flow(), 1e-4, x);
    EXPECT_EQ(with.solver.octree(), nullptr);
    EXPECT_GT(result.iterations, 200);
    EXPECT_LE(result.error_estimate, 1e-4);
    without.solver.solve(without.flow(), 1e-4, expected);
    EXPECT_LT((rows_of(x) - rows_of(expected)).norm(), 1e-3 * rows_of(expected).norm());
}

/// Returns a part of a surface as a surface of its own, with the same numbers.
Surface alone(const Surface& surface, std::int32_t part) {
    const auto [first, last] = std::equal_range(surface.parts.begin(), surface.parts.end(), part);
    const auto begin = static_cast<std::int32_t>(first - surface.parts.begin());
    const auto end = static_cast<std::int32_t>(last - surface.parts.begin());
    RawVector<Triangle> triangles;
    for (const Triangle& t : surface.stars.triangles) {
        if (surface.parts[t[0]] == part)
            triangles.push_back({t[0] - begin, t[1] - begin, t[2] - begin});
    }
    Surface result;
    result.stars = Stars(triangles, end - begin);
    result.positions.assign(surface.positions.begin() + begin, surface.positions.begin() + end);
    result.held.assign(surface.held.begin() + begin, surface.held.begin() + end);
    result.parts.assign(result.held.size(), 0);
    result.part_count = 1;
    return result;
}

/// A surface with many loose triangles inside its box.
TriangleMesh among_loose_triangles(const TriangleMesh& mesh) {
    const Eigen::Affine3d inside(Eigen::Translation3d(-0.5, -0.5, -0.5));
    return shapes::merged(
        shapes::merged(shapes::transformed(shapes::separate_triangles(150), inside), mesh),
        shapes::separate_triangles(150));
}

TEST(MeshSolver, APartHasTheSameBitsAsAlone) {
    for (const double tolerance : {1e-3, 1e-7}) {
        const TriangleMesh mesh = among_loose_triangles(noisy(bumpy_cap(20), 0.005));
        SolverOfMesh all(mesh, 0, 30);
        Vertices together;
        all.solver.solve(all.flow(), tolerance, together);
        const std::int32_t part = all.surface.parts[all.surface.vertices[mesh.triangles[150][0]]];
        SolverOfMesh one(alone(all.surface, part), 30);
        ASSERT_GT(one.surface.stars.count(), 1200);
        Vertices x;
        one.solver.solve(one.flow(), tolerance, x);
        const auto first = std::find(all.surface.parts.begin(), all.surface.parts.end(), part);
        const auto begin = together.begin() + (first - all.surface.parts.begin());
        EXPECT_TRUE(same_bits(Vertices(begin, begin + static_cast<std::ptrdiff_t>(x.size())), x));
    }
}

TEST(MeshSolver, LooseTrianglesTakeNoMoreIterations) {
    const TriangleMesh cap = noisy(bumpy_cap(20), 0.005);
    for (const int depth : {0, 3}) {
        SolverOfMesh one(cap, depth, 30), all(among_loose_triangles(cap), depth, 30);
        Vertices x;
        const int alone = one.solver.solve(one.flow(), 1e-3, x).iterations;
        const MeshConvergence result = all.solver.solve(all.flow(), 1e-3, x);
        EXPECT_LE(result.iterations, alone + 3) << depth;
        EXPECT_LE(result.error_estimate, 1e-3);
    }
}

// Single precision nearly loses the mass of parts whose edges are much shorter than others.
TEST(MeshSolver, LooseTrianglesReachAnyTolerance) {
    SolverOfMesh of(among_loose_triangles(shapes::geodesic_sphere(2)), 0, 30);
    for (const double tolerance : {1e-3, 1e-7}) {
        Vertices x;
        EXPECT_LE(of.solver.solve(of.flow(), tolerance, x).error_estimate, tolerance);
    }
}

TEST(MeshSolver, OnlyThePartThatAnOctreeDoesNotHelpGoesOnWithoutIt) {
    const TriangleMesh sphere = shapes::bumpy_sphere(30);
    SolverOfMesh of(
        shapes::merged(sphere,
                       shapes::transformed(sphere, Eigen::Affine3d(Eigen::Translation3d(3, 0, 0)))),
        3, 1e4);
    const auto middle = static_cast<std::ptrdiff_t>(sphere.positions.size());
    Vertices shuffled = of.surface.positions;
    std::shuffle(shuffled.begin(), shuffled.begin() + middle, std::mt19937(1));
    of.solver.use(
        std::make_unique<VertexOctree>(of.surface.stars, shuffled, grid_around(shuffled, 4)));
    of.solver.take(of.elements, of.step);
    Vertices x;
    const MeshConvergence result = of.solver.solve(of.flow(), 1e-4, x);
    EXPECT_NE(of.solver.octree(), nullptr);
    EXPECT_GT(result.iterations, 200);
    EXPECT_LE(result.error_estimate, 1e-4);
}

// 1ᵀ A x = 1ᵀ M x, because constants have no stiffness.
TEST(MeshSolver, ComponentsThatNothingHoldsKeepTheirCentroidsToRounding) {
    const TriangleMesh sphere = shapes::bumpy_sphere(10);
    const Eigen::Affine3d beside(Eigen::Translation3d(3, 0, 0) * Eigen::Scaling(0.5));
    const TriangleMesh mesh =
        shapes::merged(shapes::merged(bumpy_cap(14), shapes::transformed(sphere, beside)),
                       shapes::transformed(sphere, Eigen::Affine3d(Eigen::Translation3d(0, 3, 0))));
    for (const int depth : {0, 3}) {
        SolverOfMesh of(mesh, depth, 50, BoundaryCondition::Locked);
        ASSERT_EQ(of.surface.part_count, 3);
        for (const Field& b : {of.flow(), random_at_vertices(of.surface, 1)}) {
            for (const double tolerance : {0.3, 1e-3, 1e-7}) {
                Vertices x;
                of.solver.solve(b, tolerance, x);
                std::vector<Eigen::Vector3d> moved(3, Eigen::Vector3d::Zero()), pull = moved;
                std::vector<double> sizes(3, 0);
                std::vector<bool> is_held(3, false);
                for (std::int32_t i = 0; i < of.surface.stars.count(); ++i) {
                    const std::int32_t component = of.surface.parts[i];
                    moved[component] += double{of.solver.system().mass(i)} * x[i];
                    pull[component] += b.col(i).head<3>().cast<double>();
                    sizes[component] += b.col(i).head<3>().cast<double>().norm();
                    if (of.surface.held[i] != 0) is_held[component] = true;
                }
                for (int i = 0; i < 3; ++i) {
                    const double difference = (moved[i] - pull[i]).norm() / sizes[i];
                    if (is_held[i]) {
                        EXPECT_GT(difference, 1e-3) << "the boundary pulls, too";
                    } else {
                        EXPECT_LT(difference, 5e-7) << depth << ' ' << tolerance;
                    }
                }
            }
        }
    }
}

TEST(MeshSolver, ScalesWithRightSidesOfAnySize) {
    for (const int depth : {0, 3}) {
        SolverOfMesh of(bumpy_cap(14), depth, 10);
        const Field b = random_at_vertices(of.surface, 1);
        for (const double tolerance : {1e-3, 1e-8}) {
            Vertices expected, x;
            const MeshConvergence usual = of.solver.solve(b, tolerance, expected);
            for (const int exponent : {-110, 100}) {  // 8e-34, 1e30
                const MeshConvergence scaled =
                    of.solver.solve(std::ldexp(1.0F, exponent) * b, tolerance, x);
                for (Eigen::Vector3d& d : x) d = std::ldexp(1.0, -exponent) * d;
                EXPECT_TRUE(same_bits(x, expected)) << exponent;
                EXPECT_EQ(scaled.iterations, usual.iterations);
                EXPECT_EQ(scaled.error_estimate, usual.error_estimate);
                EXPECT_EQ(std::ldexp(scaled.residual_after, -exponent), usual.residual_after);
            }
        }
    }
}

TEST(MeshSolver, ANumberThatIsNoneIsReported) {
    SolverOfMesh of(bumpy_cap(14), 3, 10);
    for (const float number :
         {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
        Field b = random_at_vertices(of.surface, 1);
        b(0, 7) = number;
        Vertices x;
        EXPECT_FALSE(std::isfinite(of.solver.solve(b, 1e-3, x).error_estimate));
    }
}

TEST(MeshSolver, AnErrorThatIsNoNumberIsWorseThanAnyOther) {
    const double none = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(std::isnan(worse_of(none, 1)));
    EXPECT_TRUE(std::isnan(worse_of(1, none)));
    EXPECT_EQ(worse_of(1, 2), 2);
    EXPECT_EQ(worse_of(2, 1), 2);
}

TEST(MeshSolver, HasTheSameBitsForAnyNumberOfThreads) {
    Vertices expected;
    for (const int threads : {1, 2, 3}) {
        const ThreadTeam team(threads);
        SolverOfMesh of(shapes::bumpy_sphere(24), 4, 20);  // 5 762 vertices in 6 chunks
        Vertices x;
        of.solver.solve(random_at_vertices(of.surface, 1), 1e-7, x);
        if (threads == 1) expected = x;
        EXPECT_TRUE(same_bits(x, expected)) << threads;
    }
}

TEST(MeshSolver, ConformalizedStepsKeepTheFirstStiffness) {
    for (const int depth : {0, 3}) {
        SolverOfMesh of(bumpy_cap(14), depth, 10);
        const Eigen::MatrixXd stiffness = dense_stiffness(of.surface.stars, of.elements);
        Surface other = of.surface;
        for (Eigen::Vector3d& position : other.positions) position.z() *= 0.3;
        const TriangleElements elements = elements_of(other);
        of.solver.take(elements, 10, false);
        const Eigen::MatrixXd a = dense_mass(other.stars, elements) + 10 * stiffness;
        const Field b = random_at_vertices(of.surface, 1);
        const Eigen::MatrixXd exact = a.llt().solve(rows_of(b));
        Vertices x;
        of.solver.solve(b, 1e-6, x);
        EXPECT_LE(energy_norm(a, rows_of(x) - exact), 3e-6 * energy_norm(a, exact));
    }
}

}  // namespace
}  // namespace tracked_mcf
