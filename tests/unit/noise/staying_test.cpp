// SPDX-License-Identifier: GPL-3.0-or-later
// What must stay where it is while noise is removed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "filter_tracked_mcf/core/noise/clusters.h"
#include "filter_tracked_mcf/core/noise/rim.h"
#include "filter_tracked_mcf/core/noise/stairs.h"
#include "tests/support/measures.h"
#include "tests/support/same_bits.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_distance.h"
#include "tests/unit/flows.h"
#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

/// Returns which vertices are on the rim.
std::vector<std::uint8_t> rim_of(const TriangleMesh& mesh) {
    const Surface surface = surface_of(mesh);
    std::vector<std::uint8_t> rim(mesh.positions.size(), 0);
    for (std::size_t i = 0; i < rim.size() && surface.stars.has_rim(); ++i) {
        const std::int32_t vertex = surface.vertices[i];
        if (vertex >= 0) rim[i] = surface.stars.on_rim[vertex];
    }
    return rim;
}

/// Distances that vertices have moved, in mean edges of the clean mesh.
struct Sideways {
    double inside = 0, rim = 0;  ///< the largest
};

/// Returns how far vertices have moved at right angles to the normals of the clean mesh.
Sideways sideways(const TriangleMesh& clean, const TriangleMesh& before,
                  const TriangleMesh& after) {
    const std::vector<Eigen::Vector3d> normals = vertex_normals(clean);
    const std::vector<std::uint8_t> rim = rim_of(clean);
    const double edge = mean_edge_length(clean);
    Sideways largest;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const Eigen::Vector3d moved = after.positions[i] - before.positions[i];
        const double aside = (moved - moved.dot(normals[i]) * normals[i]).norm() / edge;
        double& most = rim[i] != 0 ? largest.rim : largest.inside;
        most = std::max(most, aside);
    }
    return largest;
}

/// Returns the RMS height over a sheet in the plane z = 0, in mean edges, of its rim or inside.
double height(const TriangleMesh& sheet, const TriangleMesh& clean, bool of_rim) {
    const std::vector<std::uint8_t> rim = rim_of(clean);
    double squares = 0;
    int count = 0;
    for (std::size_t i = 0; i < rim.size(); ++i) {
        if ((rim[i] != 0) != of_rim) continue;
        squares += sheet.positions[i][2] * sheet.positions[i][2];
        ++count;
    }
    return std::sqrt(squares / count) / mean_edge_length(clean);
}

/// A sheet whose vertices are spread unevenly in its plane.
TriangleMesh uneven_sheet() {
    constexpr int side = 40;
    TriangleMesh sheet = shapes::square(side);
    const std::vector<std::uint8_t> rim = rim_of(sheet);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> shift(-0.25 / side, 0.25 / side);
    for (std::size_t i = 0; i < rim.size(); ++i) {
        if (rim[i] == 0) sheet.positions[i] += Eigen::Vector3d(shift(random), shift(random), 0);
    }
    return sheet;
}

TriangleMesh hills(double quantum) {
    TriangleMesh terrain = shapes::square(60);
    for (Eigen::Vector3d& p : terrain.positions) {
        p[2] = 0.05 * std::sin(9 * p[0]) * std::cos(7 * p[1]) + 0.05 * p[0];
        if (quantum > 0) p[2] = quantum * std::round(p[2] / quantum);
    }
    return terrain;
}

// A NaN does not equal itself, so the positions seem to have changed.
TEST(RemoveNoise, LeavesAMeshWhoseVerticesAreAllHeldBesideANaN) {
    TriangleMesh mesh = shapes::square(1);
    NoiseParameters parameters;
    parameters.boundary = NoiseBoundary::Locked;
    mesh.positions.push_back(Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
    TriangleMesh after = mesh;
    EXPECT_EQ(remove_noise(after, {}, parameters).stop, NoiseStop::NothingMoves);
    EXPECT_TRUE(same_bits(after, mesh));
}

TEST(RemoveNoise, KeepsTheOutlineOfAnOpenSheet) {
    for (const TriangleMesh& clean :
         {shapes::square(60), uneven_sheet(), shapes::annulus(80, 15, 0.5, 1)}) {
        for (const double deviation : {0.02, 0.05, 0.2}) {
            const TriangleMesh before = with_noise(clean, deviation);
            const TriangleMesh after = denoised(before);
            EXPECT_NEAR(surface_area(after) / surface_area(clean), 1, 1e-3);
            EXPECT_LT(sideways(clean, before, after).rim, 0.05);
        }
    }
}

TEST(RemoveNoise, SmoothsARimAlongItsNormals) {
    for (const TriangleMesh& clean : {shapes::square(60), uneven_sheet()}) {
        const TriangleMesh after = denoised(with_noise(clean, 0.2));
        EXPECT_LT(height(after, clean, true), 0.4 * 0.2);
        EXPECT_LT(height(after, clean, false), 0.2 * 0.2);
    }
}

TEST(RemoveNoise, LetsVerticesSlideByTwiceTheNoise) {
    for (const TriangleMesh& clean : {uneven_sheet(), hills(0), shapes::box(20, {1, 1, 1})}) {
        for (const double deviation : {0.02, 0.1}) {
            const TriangleMesh before = with_noise(clean, deviation);
            EXPECT_LT(sideways(clean, before, denoised(before)).inside, 2.5 * deviation);
        }
    }
}

TEST(RemoveNoise, LeavesTerrainInWholeMetresAboveItsCells) {
    const TriangleMesh clean = hills(0);
    const double metre = 0.1 * mean_edge_length(clean);
    const TriangleMesh terraces = hills(metre), after = denoised(terraces);
    const double deviation = 0.1 / std::sqrt(12.0);  // of rounding, in edges
    const Sideways slid = sideways(clean, terraces, after);
    EXPECT_LT(slid.inside, 2.5 * deviation);
    EXPECT_LT(slid.rim, 0.5 * deviation);
    double squares = 0;
    for (std::size_t i = 0; i < clean.positions.size(); ++i) {
        const double error = after.positions[i][2] - clean.positions[i][2];
        squares += error * error;
    }
    EXPECT_LT(std::sqrt(squares / static_cast<double>(clean.positions.size())),
              0.4 * deviation * mean_edge_length(clean));
}

TEST(RemoveNoise, MovesVerticesAlongTheNormalsAloneIfAskedTo) {
    NoiseParameters parameters;
    parameters.along_normals = true;
    for (const TriangleMesh& clean : {uneven_sheet(), shapes::geodesic_sphere(20)}) {
        const TriangleMesh before = with_noise(clean, 0.1);
        const TriangleMesh after = denoised(before, parameters);
        // The smoothed normals are not exactly those of the clean mesh.
        EXPECT_LT(sideways(clean, before, after).inside, 0.02);
        EXPECT_LT(rms_distance(after, clean), 0.5 * rms_distance(before, clean));
    }
}

TEST(RemoveNoise, UnfoldsTrianglesThatNoiseHasFolded) {
    const TriangleMesh clean = shapes::geodesic_sphere(30);
    const auto folded = [&](const TriangleMesh& mesh) {
        return std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&](const Triangle& t) {
            return twice_vector_area(mesh, t).dot(twice_vector_area(clean, t)) < 0;
        });
    };
    const TriangleMesh before = with_isotropic_noise(clean, 0.25);
    ASSERT_GT(folded(before), 100);
    EXPECT_EQ(folded(denoised(before)), 0);
}

/// The cap of a sphere above a circle of latitude, whose rim is ragged within the sphere.
struct RaggedCap {
    TriangleMesh mesh;
    double latitude;  ///< of the rim, an angle
};

RaggedCap ragged_cap() {
    const TriangleMesh sphere = shapes::geodesic_sphere(40);
    RaggedCap cap;
    for (const Triangle& t : sphere.triangles) {
        const auto [a, b, c] = corners_of(sphere.positions, t);
        if ((a + b + c).z() > 0.3) cap.mesh.triangles.push_back(t);
    }
    cap.mesh.positions = sphere.positions;
    cap.latitude = std::asin(0.1);
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 0.3 * mean_edge_length(sphere));
    const std::vector<std::uint8_t> rim = rim_of(cap.mesh);
    for (std::size_t i = 0; i < rim.size(); ++i) {
        if (rim[i] == 0) continue;
        Eigen::Vector3d& p = cap.mesh.positions[i];
        const double latitude = cap.latitude + noise(random), longitude = std::atan2(p.y(), p.x());
        p = {std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
             std::sin(latitude)};
    }
    return cap;
}

TEST(RemoveNoise, SmoothsTheOutlineOfARimIfAskedTo) {
    const RaggedCap cap = ragged_cap();
    const std::vector<std::uint8_t> rim = rim_of(cap.mesh);
    const double edge = mean_edge_length(cap.mesh);
    NoiseParameters parameters;
    parameters.boundary = NoiseBoundary::Smooth;
    const TriangleMesh after = denoised(cap.mesh, parameters);
    double squares_before = 0, squares_after = 0, mean = 0;
    int count = 0;
    for (std::size_t i = 0; i < rim.size(); ++i) {
        if (rim[i] == 0) continue;
        const double before = std::asin(cap.mesh.positions[i].z()) - cap.latitude;
        const double latitude = std::asin(after.positions[i].z() / after.positions[i].norm());
        squares_before += before * before;
        squares_after += (latitude - cap.latitude) * (latitude - cap.latitude);
        mean += latitude - cap.latitude;
        ++count;
    }
    EXPECT_LT(squares_after, 0.3 * squares_before);
    EXPECT_LT(std::abs(mean / count), 0.05 * edge) << "the opening keeps its size";
    EXPECT_LT(sideways(cap.mesh, cap.mesh, after).inside, 0.1);
}

TEST(SmoothRim, KeepsToItsBox) {
    const RaggedCap cap = ragged_cap();
    const NoisySurface surface = surface_of_mesh(cap.mesh);
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : surface.positions) box.extend(p);
    Positions moved = surface.positions;
    smooth_rim(surface, 0.4, confinement(surface.positions), moved);
    EXPECT_NE(moved, surface.positions);
    // A box that the rim is outside of.
    Positions confined = surface.positions;
    smooth_rim(surface, 0.4, {box.center(), box.max()}, confined);
    EXPECT_EQ(confined, surface.positions);
}

TEST(RemoveNoise, LeavesWhatHasNoNoise) {
    const auto expect_kept = [](const TriangleMesh& mesh, NoiseStop stop) {
        TriangleMesh after = mesh;
        EXPECT_EQ(remove_noise(after, {}, {}).stop, stop);
        EXPECT_TRUE(same_bits(after, mesh));
    };
    for (const int n : {1, 2}) expect_kept(shapes::box(n, {1, 2, 3}), NoiseStop::TooFewVertices);
    expect_kept(shapes::box(3, {1, 2, 3}), NoiseStop::NoNoise);  // most vertices are flat
    expect_kept(with_noise(shapes::box(5, {1, 1, 1}), 0.1), NoiseStop::TooManyCreases);
    for (const TriangleMesh& mesh :
         {shapes::geodesic_sphere(20), shapes::bumpy_sphere(20), hills(0), shapes::square(30)}) {
        expect_kept(mesh, NoiseStop::NoNoise);
    }
}

/// Returns a square of n x n cells that rises in steps of `step`, each `width` cells wide.
TriangleMesh steps(int n, double step, double width) {
    TriangleMesh mesh = shapes::square(n);
    for (Eigen::Vector3d& p : mesh.positions) {
        p.z() = step * std::floor((n * p.x() + 0.25) / width + 0.3 * n * p.y() / width);
    }
    return mesh;
}

TEST(Stairs, HaveTheHeightOfTheirSteps) {
    const auto stairs_on = [](const TriangleMesh& mesh) {
        Stairs stairs = stairs_of(surface_of_mesh(mesh));
        stairs.height *= mean_edge_length(mesh);
        return stairs;
    };
    const double step = 0.7 / 60;
    const TriangleMesh stairs = steps(60, step, 2);
    const Eigen::Affine3d turn(Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()));
    for (const TriangleMesh& mesh : {stairs, shapes::transformed(stairs, turn)}) {
        EXPECT_NEAR(stairs_on(mesh).height, step, 1e-9);
        EXPECT_TRUE(stairs_on(mesh).are_certain);
    }
    // A model of four terraces may be meant.
    EXPECT_NEAR(stairs_on(steps(60, step, 20)).height, step, 1e-9);
    EXPECT_FALSE(stairs_on(steps(60, step, 20)).are_certain);
    for (const TriangleMesh& mesh : {shapes::box(30, {1, 1, 1}), shapes::geodesic_sphere(20),
                                     shapes::square(40), with_noise(stairs, 0.1)}) {
        EXPECT_EQ(stairs_on(mesh).height, 0);
    }
}

TEST(RemoveNoise, SmoothsStairs) {
    const double step = 0.7 / 60;
    const TriangleMesh stairs = steps(60, step, 2);
    /// Returns the standard deviation from the slope that the stairs follow.
    const auto error = [&](const TriangleMesh& mesh) {
        double sum = 0, squares = 0;
        for (const Eigen::Vector3d& p : mesh.positions) {
            const double height = p.z() - step * (30 * p.x() + 9 * p.y());
            sum += height;
            squares += height * height;
        }
        const auto count = static_cast<double>(mesh.positions.size());
        return std::sqrt(squares / count - sum / count * sum / count);
    };
    EXPECT_NEAR(report_of(stairs).stairs, step, 1e-9);
    EXPECT_LT(error(denoised(stairs)), 0.4 * error(stairs));
    NoiseParameters vertices;
    vertices.noise_size = 1e-6;
    const NoiseReport report = report_of(stairs, vertices);
    EXPECT_NEAR(report.noise_size, mean_edge_length(stairs), 1e-9);
    EXPECT_EQ(report.stairs, 0) << "they were not looked for";
}

TEST(RemoveNoise, RemovesNoiseOfASizeThatItIsTold) {
    const TriangleMesh clean = shapes::box(40, {1, 1, 1});
    const double edge = mean_edge_length(clean);
    const TriangleMesh lumps = with_shared_noise(clean, 0.2, 4);
    NoiseParameters parameters;
    parameters.noise_size = 4 * edge;
    const std::vector<Eigen::Vector3d> normals = vertex_normals(clean);
    const auto error = [&](const TriangleMesh& mesh) {
        double squares = 0;
        for (std::size_t i = 0; i < normals.size(); ++i) {
            const double height = (mesh.positions[i] - clean.positions[i]).dot(normals[i]);
            squares += height * height;
        }
        return std::sqrt(squares);
    };
    const TriangleMesh after = denoised(lumps, parameters);
    EXPECT_LT(error(after), 0.5 * error(lumps));
    EXPECT_DOUBLE_EQ(report_of(lumps, parameters).noise_size, 4 * edge);
    // Then there are too few lumps to see what they are, even if their height is known.
    parameters.noise_size = 1e300;
    EXPECT_EQ(report_of(lumps, parameters).stop, NoiseStop::TooFewVertices);
    parameters.noise = parameters.detail_size = edge;
    EXPECT_EQ(report_of(lumps, parameters).stop, NoiseStop::TooFewVertices);
}

TEST(Clusters, DoNotDependOnTheOrderOfVertices) {
    TriangleMesh mesh = with_noise(shapes::torus(60, 24, 1, 0.4), 0.1), reversed = mesh;
    std::reverse(reversed.positions.begin(), reversed.positions.end());
    const auto last = static_cast<std::int32_t>(mesh.positions.size()) - 1;
    for (Triangle& t : reversed.triangles) {
        for (std::int32_t& vertex : t) vertex = last - vertex;
    }
    const auto clusters_on = [](const TriangleMesh& surface) {
        return clusters_of(sample_of(surface_of_mesh(surface), 10000), 2);
    };
    const Clusters some = clusters_on(mesh), others = clusters_on(reversed);
    EXPECT_NEAR(some.edge, others.edge, 1e-9);
    EXPECT_GT(some.edge, 2);
    ASSERT_EQ(some.sample.signs.size(), others.sample.signs.size());
    EXPECT_EQ(some.sample.surface.stars.triangles.size(),
              others.sample.surface.stars.triangles.size());
    for (std::size_t i = 0; i < some.sample.signs.size(); ++i) {
        EXPECT_LT((some.sample.surface.positions[i] - others.sample.surface.positions[i]).norm(),
                  1e-9);
        EXPECT_EQ(some.sample.signs[i], others.sample.signs[i]);
    }
}

TEST(RemoveNoise, ReportsPartsThatLoseMoreThanNoise) {
    const TriangleMesh noisy = with_noise(shapes::geodesic_sphere(20), 0.2);
    EXPECT_EQ(report_of(noisy).shrunken_parts, 0) << "noise has area, and its removal is no loss";
    // A sphere beside it, so small that waves of the detail size are all of it.
    const TriangleMesh two = shapes::merged(
        noisy, shapes::transformed(shapes::geodesic_sphere(5),
                                   Eigen::Translation3d(3, 0, 0) * Eigen::Scaling(0.1)));
    NoiseParameters parameters;
    parameters.detail_size = 15 * mean_edge_length(noisy);
    parameters.crease_angle = 0;  // with creases, the noise decides how much the small one keeps
    const NoiseReport report = report_of(two, parameters);
    EXPECT_EQ(report.shrunken_parts, 1);
    EXPECT_GT(std::max(report.lost_area, report.lost_volume), 0.03);
}

}  // namespace
}  // namespace tracked_mcf
