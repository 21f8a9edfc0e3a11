// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/linear_elements.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "filter_tracked_mcf/core/noise/smoothing.h"
#include "tests/support/shapes.h"
#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

constexpr int kSide = 60;
constexpr int kMiddle = kSide / 2;

/// A square of kSide by kSide quads, all of whose vertices may move.
NoisySurface square() {
    return surface_of_mesh(shapes::square(kSide));
}

Vectors upright(const NoisySurface& surface) {
    return Vectors(surface.positions.size(), Eigen::Vector4f(0, 0, 1, 0));
}

/// Returns the heights after a step in the metric of constant normals.
std::vector<double> smoothed(const NoisySurface& surface, double step_size,
                             const std::vector<double>& heights) {
    Positions positions = surface.positions;
    for (std::size_t i = 0; i < heights.size(); ++i) positions[i][2] = heights[i];
    LinearElements elements(surface);
    elements.assemble(upright(surface), 5, step_size);
    Vectors d;
    elements.displace(positions, upright(surface), {}, d);
    std::vector<double> result = heights;
    for (std::size_t i = 0; i < heights.size(); ++i) result[i] += double{d[i][2]};
    return result;
}

std::vector<double> noise(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<double> heights(count);
    for (double& height : heights) height = normal(random);
    return heights;
}

/// Returns the masses: each triangle counts as an equilateral one of side 1.
double mass(const Stars& stars, std::int32_t vertex) {
    const double triangles = stars.corner_begin[vertex + 1] - stars.corner_begin[vertex];
    return triangles * std::sqrt(3.0) / 12;
}

// The triangles count as equilateral ones, so the Laplacian of a wave along one of three directions
// has the eigenvalue 8/3 (1 - cos(phase per edge)).
TEST(LinearElements, DampAWaveAsTheEquationSays) {
    const NoisySurface surface = square();
    for (const double step_size : {0.3, 1.2, 4.0}) {
        for (const double length : {4.0, 8.0, 15.0}) {
            const double phase = 2 * std::acos(-1.0) / length;
            std::vector<double> heights;
            const double quad =
                (surface.positions[surface.positions.size() - 1] - surface.positions[0])
                    .cwiseAbs()
                    .maxCoeff() /
                kSide;
            std::int32_t middle = 0;
            double nearest = 1e9;
            for (std::size_t i = 0; i < surface.positions.size(); ++i) {
                const Eigen::Vector3d at = (surface.positions[i] - surface.positions[0]) / quad;
                heights.push_back(0.1 * std::cos(phase * (at[0] - kMiddle)));
                const double distance = (at - Eigen::Vector3d(kMiddle, kMiddle, 0)).norm();
                if (distance < nearest) {
                    nearest = distance;
                    middle = static_cast<std::int32_t>(i);
                }
            }
            const double eigenvalue = 8.0 / 3 * (1 - std::cos(phase));
            const double kept = 1 / (1 + std::pow(step_size * eigenvalue, 2));
            EXPECT_NEAR(smoothed(surface, step_size, heights)[middle] / 0.1, kept, 0.01)
                << step_size << ", " << length;
        }
    }
}

TEST(LinearElements, KeepConstantsAndTheMeanHeight) {
    const NoisySurface surface = square();
    const std::vector<double> constant(surface.positions.size(), 3.25);
    EXPECT_EQ(smoothed(surface, 2, constant), constant);

    const std::vector<double> heights = noise(surface.positions.size(), 1);
    const std::vector<double> after = smoothed(surface, 2, heights);
    double before_sum = 0, after_sum = 0, squares = 0;
    for (std::int32_t i = 0; i < surface.stars.count(); ++i) {
        before_sum += mass(surface.stars, i) * heights[i];
        after_sum += mass(surface.stars, i) * after[i];
        squares += heights[i] * heights[i];
    }
    EXPECT_NEAR(after_sum, before_sum, 3e-3 * std::sqrt(squares));
}

TEST(LinearElements, AreSymmetric) {
    const NoisySurface surface = square();
    const std::vector<double> a = noise(surface.positions.size(), 1);
    const std::vector<double> b = noise(surface.positions.size(), 2);
    const std::vector<double> smooth_a = smoothed(surface, 1, a),
                              smooth_b = smoothed(surface, 1, b);
    double ab = 0, ba = 0, bb = 0;
    for (std::int32_t i = 0; i < surface.stars.count(); ++i) {
        ab += mass(surface.stars, i) * a[i] * smooth_b[i];
        ba += mass(surface.stars, i) * smooth_a[i] * b[i];
        bb += mass(surface.stars, i) * b[i] * smooth_b[i];
    }
    EXPECT_NEAR(ab, ba, 2e-3 * bb);
}

TEST(LinearElements, SmoothMoreAlongShortSides) {
    NoisySurface surface = square();
    for (Eigen::Vector3d& position : surface.positions) position[1] *= 3;
    const auto moved = [&](int axis, bool with_positions) {
        Positions positions = surface.positions;
        for (Eigen::Vector3d& position : positions) {
            position[2] = 0.1 * std::cos(position[axis] / (axis == 0 ? 1 : 3));
        }
        LinearElements elements(surface);
        elements.assemble(upright(surface), 5, 0.3, with_positions ? &positions : nullptr);
        Vectors d;
        elements.displace(positions, upright(surface), {}, d);
        double squares = 0;
        for (const Eigen::Vector4f& vector : d) squares += double{vector[2] * vector[2]};
        return std::sqrt(squares);
    };
    EXPECT_GT(moved(0, true), 2 * moved(1, true));
    EXPECT_NEAR(moved(0, false), moved(1, false), 1e-3 * moved(0, false));
}

TEST(LinearElements, LeaveAFlatSheetAsItIs) {
    // A sheared square, turned.
    NoisySurface surface = square();
    const Eigen::AngleAxisd turn(1, Eigen::Vector3d(1, 2, 3).normalized());
    for (Eigen::Vector3d& p : surface.positions) {
        p = turn * Eigen::Vector3d(p[0] + 0.3 * p[1], p[1], p[2]);
    }
    Vectors normals = upright(surface);
    for (Eigen::Vector4f& normal : normals) {
        normal.head<3>() = (turn * Eigen::Vector3d::UnitZ()).cast<float>();
    }
    LinearElements elements(surface);
    elements.assemble(normals, 0, 2, &surface.positions);
    Vectors d;
    elements.displace(surface.positions, normals, {}, d);
    for (const Eigen::Vector4f& vector : d) EXPECT_LT(vector.norm(), 1e-4);
}

TEST(LinearElements, KeepConstantNormals) {
    const NoisySurface surface = square();
    LinearElements elements(surface);
    elements.assemble(upright(surface), 5, 2);
    for (const bool evenly : {false, true}) {
        const auto smooth = [&](double reduction, Vectors& x) {
            return evenly ? elements.smooth_evenly(2, upright(surface), reduction, x)
                          : elements.smooth(upright(surface), reduction, x);
        };
        Vectors x(surface.positions.size(), Eigen::Vector4f::Zero());
        EXPECT_GT(smooth(2e-2, x), 1);
        for (const Eigen::Vector4f& vector : x) EXPECT_NEAR(vector[2], 1, 0.05);
        x = upright(surface);
        smooth(2e-2, x);
        for (const Eigen::Vector4f& vector : x) EXPECT_NEAR(vector[2], 1, 1e-5);
    }
}

/// Meshes with needles, a rim, a fan of many triangles, and sides with three triangles. They are
/// small enough for dense matrices.
std::vector<TriangleMesh> nasty_meshes() {
    TriangleMesh sphere = with_isotropic_noise(shapes::geodesic_sphere(4), 0.4);
    TriangleMesh stretched = with_noise(shapes::square(12), 0.3);
    for (Eigen::Vector3d& p : stretched.positions) p[0] *= 30 * (1 + p[0] * p[0]);
    TriangleMesh fan;
    fan.positions.emplace_back(0, 0, 0);
    for (int i = 0; i < 80; ++i) {
        fan.positions.emplace_back(std::cos(0.01 * i * i), std::sin(0.01 * i * i), 0.1 * (i % 3));
        if (i > 0) fan.triangles.push_back({0, i, i + 1});
    }
    TriangleMesh book = shapes::square(6);
    const auto spine = static_cast<std::int32_t>(book.positions.size());
    for (int i = 0; i < 5; ++i) {
        book.positions.emplace_back(0.1 * i, 0.3, 0.5);
        book.triangles.push_back({book.triangles[0][0], book.triangles[0][1], spine + i});
    }
    return {sphere, stretched, fan, book};
}

/// Returns δ M⁻¹ L.
Eigen::MatrixXd dense_curvature(const LinearElements& elements, std::int32_t count) {
    Eigen::MatrixXd matrix(count, count);
    Vectors unit(static_cast<std::size_t>(count), Eigen::Vector4f::Zero());
    for (std::int32_t column = 0; column < count; ++column) {
        unit[column][0] = 1;
        for (std::int32_t row = 0; row < count; ++row)
            matrix(row, column) = double{elements.curvature(unit, row)[0]};
        unit[column][0] = 0;
    }
    return matrix;
}

TEST(LinearElements, KnowABoundOfTheirLargestEigenvalue) {
    for (const TriangleMesh& mesh : nasty_meshes()) {
        const NoisySurface surface = surface_of_mesh(mesh);
        Smoothing smoothing(surface);
        const Vectors normals = smoothing.smooth_normals(surface.positions, {3, 1, 2});
        for (const double step_size : {0.04, 1.2, 40.0}) {
            LinearElements elements(surface);
            elements.assemble(normals, 3, step_size, &surface.positions);
            const Eigen::VectorXcd eigenvalues =
                dense_curvature(elements, surface.stars.count()).eigenvalues();
            const double largest = eigenvalues.cwiseAbs().maxCoeff();
            EXPECT_LE(largest, elements.largest_eigenvalue() * (1 + 1e-5));
            EXPECT_GE(largest, elements.largest_eigenvalue() / 3);
            EXPECT_LE(elements.largest_eigenvalue(), std::max(16.0, 12 * step_size) * (1 + 1e-5));
        }
    }
}

TEST(LinearElements, DisplaceAsADenseSolutionDoes) {
    for (const TriangleMesh& mesh : nasty_meshes()) {
        for (const double step_size : {0.3, 4.0, 1000.0}) {
            // Conjugate gradients stop early where the condition number is large.
            for (const bool holds : {false, step_size < 1}) {
                NoisySurface surface = surface_of_mesh(mesh);
                if (holds) surface.fidelity[1] = 0, surface.fidelity[3] = 2;
                const std::int32_t count = surface.stars.count();
                Smoothing smoothing(surface);
                const Vectors normals = smoothing.smooth_normals(surface.positions, {3, 1, 2});
                std::vector<float> heights(surface.positions.size());
                for (std::int32_t i = 0; i < count; ++i)
                    heights[i] = static_cast<float>(noise(heights.size(), 3)[i]);
                LinearElements elements(surface);
                elements.assemble(normals, 3, step_size, &surface.positions);
                Vectors d;
                elements.displace(surface.positions, normals, heights, d);

                const Eigen::MatrixXd k = dense_curvature(elements, count);
                Eigen::VectorXd before(count), fidelity(count), found(count);
                for (std::int32_t i = 0; i < count; ++i) {
                    before[i] = double{heights[i]};
                    fidelity[i] = double{surface.fidelity[i]};
                    found[i] = double{d[i][3]};
                }
                const Eigen::MatrixXd square = k * k;
                Eigen::MatrixXd system = square;
                system.diagonal() += fidelity;
                Eigen::VectorXd right = -square * before;
                for (std::int32_t i = 0; i < count; ++i) {
                    if (fidelity[i] > 0) continue;
                    system.row(i).setZero();
                    system(i, i) = 1;
                    right[i] = 0;
                }
                const Eigen::VectorXd exact = system.partialPivLu().solve(right);
                EXPECT_LT((found - exact).norm(), 0.02 * exact.norm()) << step_size << holds;
            }
        }
    }
}

TEST(LinearElements, SmoothAsADenseSolutionDoes) {
    for (const TriangleMesh& mesh : nasty_meshes()) {
        const NoisySurface surface = surface_of_mesh(mesh);
        const std::int32_t count = surface.stars.count();
        Vectors b(surface.positions.size());
        const std::vector<double> heights = noise(b.size(), 1);
        for (std::int32_t i = 0; i < count; ++i) b[i] << static_cast<float>(heights[i]), 0, 0, 0;
        const Vectors normals = Smoothing(surface).smooth_normals(surface.positions, {3, 1, 2});
        for (const double length : {0.0, 3.0}) {
            LinearElements elements(surface);
            elements.assemble(length > 0 ? normals : upright(surface), length, 2);
            const auto error = [&](const Vectors& x) {
                Eigen::MatrixXd system = dense_curvature(elements, count);
                system.diagonal().array() += 1;
                const Eigen::VectorXd exact = system.partialPivLu().solve(
                    Eigen::Map<const Eigen::VectorXd>(heights.data(), count));
                double square = 0;
                for (std::int32_t i = 0; i < count; ++i) {
                    const double difference = double{x[i][0]} - exact[i];
                    square += difference * difference;
                }
                return std::sqrt(square) / exact.norm();
            };
            Vectors x = b;
            elements.smooth(b, 1e-3, x);
            EXPECT_LT(error(x), 5e-3) << length;
            if (length > 0) continue;
            Vectors even = b;
            elements.smooth_evenly(2, b, 1e-3, even);
            EXPECT_LT(error(even), 5e-3);
        }
    }
}

TEST(LinearElements, DoNotSmoothAcrossACrease) {
    // A step of height 1 in the middle, where the normals turn by 90 degrees.
    const NoisySurface surface = square();
    const double middle =
        surface.positions[0][0] + (surface.positions.back() - surface.positions[0])[0] / 2;
    Vectors normals = upright(surface);
    Positions positions = surface.positions;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (positions[i][0] < middle) continue;
        normals[i] = {1, 0, 0, 0};
        positions[i][2] = 1;
    }
    const auto moved = [&](double normal_length) {
        LinearElements elements(surface);
        elements.assemble(normals, normal_length, 1);
        Vectors d;
        elements.displace(positions, normals, {}, d);
        double squares = 0;
        for (const Eigen::Vector4f& vector : d) squares += double{vector[2] * vector[2]};
        return std::sqrt(squares);
    };
    EXPECT_LT(moved(9), 0.2 * moved(0));
}

}  // namespace
}  // namespace tracked_mcf
