// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/element_smoother.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <string>

#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

/// A smoother for the finest level of a system.
struct Smoother {
    explicit Smoother(const LevelSystem& system)
        : partition(system.finest()), smoother(system.finest(), partition) {
        smoother.refresh(system.matrices);
    }
    Field apply(const Field& residual) const {
        Field x;
        smoother.correct(nullptr, 1, residual, x);
        return x;
    }

    ElementPartition partition;
    ElementSmoother smoother;
};

/// Returns S residual by definition, in double.
Dense corrected(const LevelSystem& system, const Dense& residual) {
    const Dense a = assembled(system);
    const auto& unknowns = system.finest().unknowns;
    std::vector<int> sharing(static_cast<std::size_t>(a.rows()), 0);
    for (const auto& of_element : unknowns) {
        for (const std::int32_t unknown : of_element) ++sharing[unknown];
    }
    Dense x = Dense::Zero(a.rows(), residual.cols());
    for (const auto& of_element : unknowns) {
        Dense local(8, 8), right_side(8, residual.cols());
        int most = 0;
        for (int i = 0; i < 8; ++i) {
            most = std::max(most, sharing[of_element[i]]);
            right_side.row(i) = residual.row(of_element[i]);
            for (int j = 0; j < 8; ++j) local(i, j) = a(of_element[i], of_element[j]);
        }
        const Dense solved = local.llt().solve(right_side) / most;
        for (int i = 0; i < 8; ++i) x.row(of_element[i]) += solved.row(i);
    }
    return x;
}

TEST(ElementSmoother, SumsTheDampedSolutionsOfAllElements) {
    const LevelSystem system = vertex_system(shapes::bumpy_sphere(12), 3, 0.5);
    const Field residual = random_right_side(system);
    const Dense expected = corrected(system, residual.cast<double>().transpose());
    const Dense error = Smoother(system).apply(residual).cast<double>().transpose() - expected;
    const Dense a = assembled(system);
    // The energy norm, because coefficients of nearly dependent functions are ill conditioned.
    EXPECT_LT(error.cwiseProduct(a * error).sum(),
              1e-6 * expected.cwiseProduct(a * expected).sum());
}

TEST(ElementSmoother, IsSymmetric) {
    const LevelSystem system = vertex_system(shapes::bumpy_sphere(20), 5, 0.5);
    const Smoother smoother(system);
    const Field a = random_right_side(system), b = random_right_side(system);
    const double one = dot(b, smoother.apply(a)).sum(), other = dot(a, smoother.apply(b)).sum();
    EXPECT_NEAR(one, other, 1e-4 * std::abs(one));
    EXPECT_GT(dot(a, smoother.apply(a)).sum(), 0);
}

/// Returns the largest eigenvalue of S A by the power method.
double largest_eigenvalue(const LevelSystem& system) {
    const Smoother smoother(system);
    Field x = random_field(system.finest());
    double eigenvalue = 0;
    for (int i = 0; i < 60; ++i) {
        x = smoother.apply(times(system, x));
        eigenvalue = norm(x);
        x *= static_cast<float>(1 / eigenvalue);
    }
    return eigenvalue;
}

TEST(ElementSmoother, SpectrumIsBoundedOnAnySurface) {
    // The multigrid's smoothing steps are stable up to about 2.
    const std::vector<std::pair<std::string, TriangleMesh>> meshes = {
        {"sphere", shapes::bumpy_sphere(20)},
        {"shells", two_shells()},
        {"triangles", shapes::separate_triangles(300)},
        {"torus", shapes::torus(60, 20, 1, 0.1)},
        {"box", shapes::box(8, {1, 1, 1})},
        {"annulus", shapes::annulus(40, 8, 0.5, 1)}};
    for (const auto& [name, mesh] : meshes) {
        for (const int depth : {3, 5}) {
            for (const double step : {1e-2, 1.0, 1e3}) {
                const LevelSystem system = vertex_system(mesh, depth, step);
                const double largest = largest_eigenvalue(system);
                EXPECT_LT(largest, 1.8) << name << ' ' << depth << ' ' << step;
                EXPECT_GT(largest, 0.5) << name << ' ' << depth << ' ' << step;
            }
        }
    }
}

TEST(ElementSmoother, KeepsConstrainedUnknownsAtZero) {
    TriangleMesh mesh = shapes::bumpy_sphere(6);
    mesh.triangles.resize(mesh.triangles.size() / 2);
    FirstStep step(mesh, 3, 0.5, true);
    const std::vector<std::uint8_t>& constrained = step.constrained.back();
    eliminate_constrained(step.elements.finest(), constrained, step.systems.matrices);
    const LevelSystem system = step.levels();
    const Smoother smoother(system);
    const Field x = smoother.apply(random_field(step.elements.finest()));
    int count = 0;
    for (std::int32_t i = 0; i < x.cols(); ++i) {
        EXPECT_EQ(x.col(i).isZero(0), constrained[i] != 0);
        EXPECT_EQ(smoother.smoother.free_unknowns()[i] == 0, constrained[i] != 0);
        count += constrained[i];
    }
    EXPECT_GT(count, 20);
}

TEST(ElementSmoother, ConvergesWithDependentFunctions) {
    // A flat patch in a grid plane: four functions of each element are zero on the patch.
    const LevelSystem system = FirstStep(shapes::square(8), 2, 0.5).levels();
    const Smoother smoother(system);
    Field residual = random_right_side(system);
    const double before = norm(residual);
    for (int i = 0; i < 20; ++i) {
        const Field step = smoother.apply(residual);
        EXPECT_TRUE(step.allFinite());
        residual -= times(system, step);
    }
    EXPECT_LT(norm(residual), 0.1 * before);
}

}  // namespace
}  // namespace tracked_mcf
