// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/smoothing.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

const StepSettings kSmoothingStep = {5, 2, 2, std::numeric_limits<double>::infinity()};

double farthest(const Positions& before, const Positions& after) {
    double largest = 0;
    for (std::size_t i = 0; i < before.size(); ++i)
        largest = std::max(largest, (after[i] - before[i]).norm());
    return largest;
}

TEST(Smoothing, MovesNoVertexOfAPlane) {
    const NoisySurface surface = surface_of_mesh(shapes::transformed(
        shapes::square(20),
        Eigen::Affine3d(Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()))));
    Smoothing smoothing(surface);
    Positions positions = surface.positions;
    ASSERT_TRUE(smoothing.step(kSmoothingStep, confinement(positions), positions));
    EXPECT_LT(farthest(surface.positions, positions), 1e-4);
}

TEST(Smoothing, MovesAllVerticesOfARegularPolyhedronAlongTheirRadii) {
    const NoisySurface surface = surface_of_mesh(shapes::geodesic_sphere(1));
    Smoothing smoothing(surface);
    Positions positions = surface.positions;
    ASSERT_TRUE(smoothing.step(kSmoothingStep, confinement(positions), positions));
    const double factor = positions[0].norm() / surface.positions[0].norm();
    EXPECT_LT(factor, 0.99);
    for (std::size_t i = 0; i < positions.size(); ++i)
        EXPECT_LT((positions[i] - factor * surface.positions[i]).norm(), 1e-5) << i;
}

TEST(Smoothing, LimitsHowFarVerticesSlide) {
    const NoisySurface surface = surface_of_mesh(with_isotropic_noise(shapes::bumpy_sphere(8), .2));
    const double limit = 0.05;
    StepSettings settings = kSmoothingStep;
    settings.sideways = limit;
    Smoothing smoothing(surface);
    Positions positions = surface.positions;
    ASSERT_TRUE(smoothing.step(settings, confinement(positions), positions));
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Eigen::Vector3d normal = smoothing.normals()[i].head<3>().cast<double>();
        const Eigen::Vector3d moved = positions[i] - surface.positions[i];
        // Twice as far where the star was folded.
        EXPECT_LE((moved - moved.dot(normal) * normal).norm(), 2 * limit + 1e-6) << i;
    }
    EXPECT_GT(farthest(surface.positions, positions), 2 * limit);
}

TEST(Smoothing, MakesNoStepThatLeavesTheBox) {
    const NoisySurface surface = surface_of_mesh(with_noise(shapes::bumpy_sphere(8), .2));
    Smoothing smoothing(surface);
    Positions positions = surface.positions;
    const Eigen::AlignedBox3d point(positions[0], positions[0]);
    EXPECT_FALSE(smoothing.step(kSmoothingStep, point, positions));
    EXPECT_EQ(positions, surface.positions);
}

/// Mass and stiffness of linear elements whose squared sides are 1 + s² |ΔN|².
struct DenseElements {
    Eigen::MatrixXd stiffness;
    Eigen::VectorXd masses;
};

DenseElements dense_elements(const Stars& stars, const Vectors& normals, double normal_length) {
    DenseElements dense{Eigen::MatrixXd::Zero(stars.count(), stars.count()),
                        Eigen::VectorXd::Zero(stars.count())};
    const auto square = [&](std::int32_t a, std::int32_t b) {
        return 1 + normal_length * normal_length * double{(normals[a] - normals[b]).squaredNorm()};
    };
    for (const Triangle& t : stars.triangles) {
        const double sides[3] = {square(t[1], t[2]), square(t[2], t[0]), square(t[0], t[1])};
        // Heron's formula, with squares.
        double sixteen_squares = 0;
        for (int k = 0; k < 3; ++k)
            sixteen_squares += 2 * sides[k] * sides[(k + 1) % 3] - sides[k] * sides[k];
        const double area = std::sqrt(sixteen_squares) / 4;
        for (int k = 0; k < 3; ++k) {
            const std::int32_t a = t[(k + 1) % 3], b = t[(k + 2) % 3];
            const double half_cotangent =
                (sides[(k + 1) % 3] + sides[(k + 2) % 3] - sides[k]) / (8 * area);
            dense.stiffness(a, a) += half_cotangent;
            dense.stiffness(b, b) += half_cotangent;
            dense.stiffness(a, b) -= half_cotangent;
            dense.stiffness(b, a) -= half_cotangent;
            dense.masses[t[k]] += area / 3;
        }
    }
    return dense;
}

/// Expects that a displacement is that of a dense solve.
void compare_with_dense_solve(bool has_fidelities) {
    NoisySurface surface = surface_of_mesh(shapes::geodesic_sphere(3));
    std::mt19937 random(1);
    std::normal_distribution<float> noise;
    Vectors normals(surface.positions.size());
    Positions positions = surface.positions;
    const auto count = static_cast<Eigen::Index>(positions.size());
    Eigen::MatrixXd x(count, 3);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        normals[i] << positions[i].normalized().cast<float>(), 0;
        normals[i].head<3>() += 0.1F * Eigen::Vector3f(noise(random), noise(random), noise(random));
        positions[i] *= 1 + 0.1 * double{noise(random)};
        if (has_fidelities) surface.fidelity[i] = 1 + 0.5F * static_cast<float>(i % 3);
        x.row(static_cast<Eigen::Index>(i)) = positions[i].transpose();
    }
    const double step_size = 0.7, normal_length = 2;
    const DenseElements dense = dense_elements(surface.stars, normals, normal_length);
    const Eigen::MatrixXd bending = step_size * step_size * dense.stiffness *
                                    dense.masses.cwiseInverse().asDiagonal() * dense.stiffness;
    Eigen::MatrixXd matrix = bending;
    for (Eigen::Index i = 0; i < count; ++i)
        matrix(i, i) += dense.masses[i] * double{surface.fidelity[static_cast<std::size_t>(i)]};
    const Eigen::MatrixXd expected = -matrix.ldlt().solve(bending * x);

    LinearElements elements(surface);
    elements.assemble(normals, normal_length, step_size);
    Vectors d;
    elements.displace(positions, normals, {}, d);
    for (Eigen::Index i = 0; i < count; ++i) {
        const Eigen::Vector3d found = d[static_cast<std::size_t>(i)].head<3>().cast<double>();
        EXPECT_LT((found - expected.row(i).transpose()).norm(),
                  5e-3 * expected.rowwise().norm().maxCoeff())
            << i;
    }
}

TEST(Smoothing, ItsDisplacementIsThatOfADenseSolve) {
    compare_with_dense_solve(false);
    compare_with_dense_solve(true);
}

}  // namespace
}  // namespace tracked_mcf
