// SPDX-License-Identifier: GPL-3.0-or-later
// Each kind of noise, and what is none.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/remove_noise.h"
#include "tests/support/measures.h"
#include "tests/support/same_bits.h"
#include "tests/support/shapes.h"
#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

TEST(RemoveNoise, HardlyBelievesOutliers) {
    for (const TriangleMesh& clean : {shapes::geodesic_sphere(20), cube()}) {
        const TriangleMesh far = with_noise(clean, 0.4);
        TriangleMesh before = clean;
        for (std::size_t i = 0; i < before.positions.size(); i += 5) {
            before.positions[i] = far.positions[i];
        }
        // Outliers leave at most half of what as much noise everywhere leaves.
        const double left =
            error_along_normals(denoised(far), clean) / error_along_normals(far, clean);
        EXPECT_LT(error_along_normals(denoised(before), clean),
                  0.5 * left * error_along_normals(before, clean));
        // Most of the fifth that was moved has moved far enough to be told.
        const NoiseReport report = report_of(before);
        const double share =
            static_cast<double>(report.outliers) / static_cast<double>(report.vertices);
        EXPECT_LE(share, 0.2);
        EXPECT_GT(share, 0.1);
        EXPECT_EQ(report_of(far).outliers, 0);
    }
}

TEST(RemoveNoise, HardlyBelievesOutliersBesideALockedRim) {
    const TriangleMesh clean = shapes::square(40), far = with_noise(clean, 0.4);
    TriangleMesh before = clean;
    std::int64_t moved = 0;
    for (std::size_t i = 0; i < before.positions.size(); i += 6, ++moved) {
        before.positions[i] = far.positions[i];
    }
    NoiseParameters parameters;
    parameters.boundary = NoiseBoundary::Locked;
    EXPECT_GT(report_of(before, parameters).outliers, moved / 2);
    expect_halved(denoised(before, parameters), before, clean);
}

/// Returns the mesh with the vertices of `clean` where x does not have this sign.
TriangleMesh half_of(TriangleMesh mesh, const TriangleMesh& clean, double sign) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (sign * clean.positions[i].x() <= 0) mesh.positions[i] = clean.positions[i];
    }
    return mesh;
}

TEST(RemoveNoise, SmoothsMoreWhereTheNoiseIsLarger) {
    const TriangleMesh clean = shapes::bumpy_sphere(30);
    TriangleMesh before = half_of(with_noise(clean, 0.4), clean, 1);
    const TriangleMesh quiet = half_of(with_noise(clean, 0.05), clean, -1);
    for (std::size_t i = 0; i < before.positions.size(); ++i) {
        if (clean.positions[i].x() <= 0) before.positions[i] = quiet.positions[i];
    }
    NoiseParameters everywhere;
    everywhere.noise = report_of(before).noise;
    const TriangleMesh after = denoised(before), alike = denoised(before, everywhere);
    EXPECT_LT(error_along_normals(half_of(after, clean, -1), clean),
              error_along_normals(half_of(alike, clean, -1), clean));
    expect_halved(half_of(after, clean, 1), half_of(before, clean, 1), clean);
}

class NoiseInACorner : public ::testing::TestWithParam<Eigen::Vector2d> {};

TEST_P(NoiseInACorner, IsSmoothedMoreThoughTheSampleDoesNotShowIt) {
    TriangleMesh clean = shapes::square(120);  // the sample has a third of its vertices
    for (Eigen::Vector3d& p : clean.positions) p.z() = 0.03 * std::sin(9 * p.x()) * p.y();
    const TriangleMesh loud = with_noise(clean, 0.4);
    TriangleMesh before = with_noise(clean, 0.08);
    std::vector<std::size_t> corner;
    for (std::size_t i = 0; i < clean.positions.size(); ++i) {
        const Eigen::Vector2d difference = clean.positions[i].head<2>() - GetParam();
        if (difference.cwiseAbs().maxCoeff() < 0.4) corner.push_back(i);
    }
    for (const std::size_t i : corner) before.positions[i] = loud.positions[i];
    TriangleMesh after = denoised(before);
    expect_halved(after, before, clean);
    for (const std::size_t i : corner) {
        after.positions[i] = before.positions[i] = clean.positions[i];
    }
    expect_halved(after, before, clean);
}

INSTANTIATE_TEST_SUITE_P(RemoveNoise, NoiseInACorner,
                         ::testing::Values(Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 1),
                                           Eigen::Vector2d(1, 0), Eigen::Vector2d(1, 1)));

TEST(RemoveNoise, SmoothsAlsoWhereTheNoiseIsAHundredTimesAsLarge) {
    TriangleMesh clean = shapes::square(70);
    const double edge = mean_edge_length(clean);
    for (Eigen::Vector3d& p : clean.positions) p.z() = 0.1 * std::sin(6 * p.x()) * p.y();
    const TriangleMesh noisy = with_noise(clean, 1);
    TriangleMesh before = clean;
    for (std::size_t i = 0; i < before.positions.size(); ++i) {
        const double deviation = 0.01 * std::exp(4.6 * clean.positions[i].x());
        before.positions[i] += deviation * (noisy.positions[i] - clean.positions[i]);
    }
    expect_halved(denoised(before), before, clean);
    EXPECT_LT(error_along_normals(before, clean), edge);
}

TEST(RemoveNoise, RemovesNoiseThatNeighboursShare) {
    for (const TriangleMesh& clean :
         {shapes::geodesic_sphere(30), shapes::torus(160, 60, 1, 0.4)}) {
        const TriangleMesh before = with_shared_noise(clean, 0.2, 2);
        TriangleMesh after = before;
        const NoiseReport report = remove_noise(after, {}, {});
        const double edge = mean_edge_length(clean);
        EXPECT_EQ(report.kind, NoiseKind::Shared);
        EXPECT_GT(report.noise_size, 1.6 * edge);
        EXPECT_LT(report.noise_size, 3.4 * edge);
        EXPECT_NEAR(report.noise, 0.2 * edge, 0.08 * edge);
        EXPECT_GT(report.evenness, 0.75);
        expect_halved(after, before, clean);
    }
}

// Their evenness is that of detail.
TEST(RemoveNoise, TakesLumpsIfAskedTo) {
    const TriangleMesh clean = shapes::geodesic_sphere(30),
                       lumps = with_shared_noise(clean, 0.2, 2);
    TriangleMesh before = clean;
    for (std::size_t i = 0; i < before.positions.size(); ++i) {
        const double share = 0.7 + 0.3 * std::sin(5 * clean.positions[i].x());
        before.positions[i] += share * (lumps.positions[i] - clean.positions[i]);
    }
    EXPECT_EQ(report_of(before).stop, NoiseStop::NoNoise);
    EXPECT_TRUE(same_bits(denoised(before), before));
    NoiseParameters parameters;
    parameters.lumps = true;
    EXPECT_EQ(report_of(before, parameters).kind, NoiseKind::Shared);
    EXPECT_LT(error_along_normals(denoised(before, parameters), clean),
              0.8 * error_along_normals(before, clean));
}

TEST(RemoveNoise, FindsNoiseInOnePlaceWhereverItIs) {
    const TriangleMesh clean = shapes::geodesic_sphere(30), noisy = with_noise(clean, 0.3);
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (int i = 0; i < 4; ++i) {
        const Eigen::Vector3d direction =
            Eigen::Vector3d(normal(random), normal(random), normal(random)).normalized();
        TriangleMesh before = clean;
        for (std::size_t v = 0; v < before.positions.size(); ++v) {
            if (clean.positions[v].dot(direction) > 0.8) before.positions[v] = noisy.positions[v];
        }
        TriangleMesh after = before;
        EXPECT_EQ(remove_noise(after, {}, {}).kind, NoiseKind::Varying) << i;
        expect_halved(after, before, clean);
    }
}

TEST(RemoveNoise, TakesSpikesAwayBesideOtherNoise) {
    const TriangleMesh clean = shapes::geodesic_sphere(20);
    const std::vector<Eigen::Vector3d> normals = vertex_normals(clean);
    for (const double noise : {0.0, 0.1}) {
        TriangleMesh before = with_noise(clean, noise);
        std::int64_t count = 0;
        for (std::size_t i = 50; i < normals.size(); i += 100, ++count)
            before.positions[i] += (i % 200 == 50 ? 3 : -4) * mean_edge_length(clean) * normals[i];
        const NoiseReport report = report_of(before);
        EXPECT_GE(report.outliers, count);
        EXPECT_EQ(report.kind, noise == 0 ? NoiseKind::Outliers : NoiseKind::White);
        EXPECT_LT(error_along_normals(denoised(before), clean),
                  0.15 * error_along_normals(before, clean))
            << noise;
    }
}

// Strokes are as wide as half a ripple, and ten times as high.
TEST(RemoveNoise, KeepsALetterBesideRipples) {
    TriangleMesh before = shapes::square(80);
    const double edge = 1.0 / 80;
    std::vector<std::int32_t> letter;
    for (std::size_t i = 0; i < before.positions.size(); ++i) {
        Eigen::Vector3d& p = before.positions[i];
        const double x = p.x() / edge, y = p.y() / edge;
        const bool is_stroke = y > 20 && y < 60 && ((x > 20 && x < 27) || (x > 50 && x < 57));
        if (is_stroke) letter.push_back(static_cast<std::int32_t>(i));
        p.z() = edge * (0.5 * std::sin(x / 2.2) * std::cos(0.1 * y) + (is_stroke ? 5 : 0));
    }
    NoiseParameters parameters;
    parameters.noise_size = 7 * edge;
    const TriangleMesh after = denoised(before, parameters);
    double height = 0;
    for (const std::int32_t vertex : letter) height += after.positions[vertex].z();
    EXPECT_GT(height / static_cast<double>(letter.size()), 4 * edge);
}

/// Returns a turned part of `sides` sides, whose levels are far apart in some places.
TriangleMesh turned_part(int sides, int levels) {
    TriangleMesh mesh;
    double z = 0;
    for (int level = 0; level < levels; ++level, z += level % 4 == 0 ? 20.0 : 0.3) {
        const double radius = 10 + 2 * std::sin(0.9 * level);
        for (int side = 0; side < sides; ++side) {
            const double turn = 6.283185307179586 * side / sides;
            mesh.positions.emplace_back(radius * std::cos(turn), radius * std::sin(turn), z);
        }
    }
    const auto first = static_cast<std::int32_t>(mesh.positions.size());
    mesh.positions.emplace_back(0, 0, 0);
    mesh.positions.emplace_back(0, 0, mesh.positions[static_cast<std::size_t>(first) - 1].z());
    for (int side = 0; side < sides; ++side) {
        const int next = (side + 1) % sides, top = (levels - 1) * sides;
        mesh.triangles.push_back({next, side, first});
        mesh.triangles.push_back({top + side, top + next, first + 1});
        for (int level = 0; level + 1 < levels; ++level) {
            const int low = level * sides, high = low + sides;
            mesh.triangles.push_back({low + side, low + next, high + next});
            mesh.triangles.push_back({low + side, high + next, high + side});
        }
    }
    return mesh;
}

TEST(RemoveNoise, KeepsTheBitsOfModelledParts) {
    for (const int sides : {12, 24, 40}) {
        const TriangleMesh part = turned_part(sides, 24);
        const NoiseReport report = report_of(part);
        EXPECT_EQ(report.stop, NoiseStop::ModelledPart) << sides << " " << report.flat_edges;
        EXPECT_GT(report.flat_edges, 0.2);
        EXPECT_TRUE(same_bits(denoised(part), part));
    }
}

/// Returns a wavy sheet with pits at this distance from each other, which are so deep. Lengths are
/// in cells of the sheet.
TriangleMesh pits(double distance, double depth) {
    constexpr int cells = 90;
    TriangleMesh mesh = shapes::square(cells);
    for (Eigen::Vector3d& p : mesh.positions) {
        p *= cells;
        const auto from_middle = [&](double x) {
            return x + 0.3 - distance * (std::floor((x + 0.3) / distance) + 0.5);
        };
        const bool inside = std::hypot(from_middle(p.x()), from_middle(p.y())) < distance / 4;
        p.z() = 6 * std::sin(p.x() / 31) * std::cos(p.y() / 27) - (inside ? depth : 0);
    }
    return mesh;
}

// They pass for white noise if they are shallow, for outliers if they are deep, and large ones for
// noise that neighbours share. One coordinate is -0.
TEST(RemoveNoise, KeepsTheBitsOfPits) {
    for (const auto& [distance, depth] :
         {std::pair(8, 0.1), std::pair(8, 0.3), std::pair(12, 0.6)}) {
        TriangleMesh before = pits(distance, depth);
        before.positions[0].y() = -0.0;
        TriangleMesh after = before;
        EXPECT_EQ(remove_noise(after, {}, {}).stop, NoiseStop::NoNoise) << distance << " " << depth;
        EXPECT_TRUE(same_bits(after, before)) << distance << " " << depth;
    }
}

// The plate is thinner than an edge, and its noise, so smoothing folds it.
TEST(RemoveNoise, KeepsTheBitsIfAllPartsWouldLoseMoreThanNoise) {
    const TriangleMesh before = with_noise(shapes::box(12, {1, 1, 0.005}), 0.2);
    const NoiseReport report = report_of(before);
    EXPECT_EQ(report.stop, NoiseStop::TooMuchLost);
    EXPECT_EQ(report.kind, NoiseKind::None);
    EXPECT_EQ(report.kept_parts, 1);
    EXPECT_GT(report.turned_triangles, 10);
    EXPECT_TRUE(same_bits(denoised(before), before));
}

// The small spheres have so few triangles that smoothing shrinks them.
TEST(RemoveNoise, TakesPartsBackThatWouldLoseMoreThanNoise) {
    const TriangleMesh large = with_noise(shapes::geodesic_sphere(30), 0.2);
    TriangleMesh before = large;
    const TriangleMesh small = shapes::transformed(
        shapes::geodesic_sphere(2), Eigen::Translation3d(3, 0, 0) * Eigen::Scaling(2.0 / 30));
    before = shapes::merged(before, small);
    const NoiseReport report = report_of(before);
    EXPECT_EQ(report.stop, NoiseStop::None);
    EXPECT_EQ(report.kept_parts, 1);
    EXPECT_EQ(report.shrunken_parts, 1);
    const TriangleMesh after = denoised(before);
    for (std::size_t i = 0; i < before.positions.size(); ++i)
        EXPECT_EQ(after.positions[i] == before.positions[i], i >= large.positions.size());
    NoiseParameters parameters;
    parameters.noise = 0.2 * mean_edge_length(large);
    EXPECT_EQ(report_of(before, parameters).kept_parts, 0) << "the noise is told";
}

}  // namespace
}  // namespace tracked_mcf
