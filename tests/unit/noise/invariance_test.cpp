// SPDX-License-Identifier: GPL-3.0-or-later
// The result of removing noise does not depend on how the mesh is written down, or on the machine.

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/remove_noise.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_distance.h"
#include "tests/unit/flows.h"
#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

TEST(RemoveNoise, TurnsAndScalesWithTheMesh) {
    const TriangleMesh before = with_noise(cube(), 0.2);
    const double edge = mean_edge_length(before);
    const TriangleMesh after = denoised(before);
    const Eigen::Affine3d turn(Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()));
    EXPECT_LT(
        rms_distance(denoised(shapes::transformed(before, turn)), shapes::transformed(after, turn)),
        1e-3 * edge);
    const Eigen::Affine3d twice(Eigen::Scaling(2.0));
    EXPECT_TRUE(
        same_bits(denoised(shapes::transformed(before, twice)), shapes::transformed(after, twice)));
    for (const double scale : {1e-50, 1e50}) {
        const Eigen::Affine3d larger{Eigen::Scaling(scale)}, smaller{Eigen::Scaling(1 / scale)};
        TriangleMesh mesh = shapes::transformed(before, larger);
        const NoiseReport report = remove_noise(mesh, {}, {});
        EXPECT_NEAR(report.noise / scale, report_of(before).noise, 1e-3 * edge);
        EXPECT_LT(rms_distance(shapes::transformed(mesh, smaller), after), 1e-3 * edge);
    }
}

TEST(RemoveNoise, DoesNotDependOnTheOrderOfTrianglesOrTheirOrientation) {
    const TriangleMesh before = with_noise(cube(), 0.2);
    const TriangleMesh after = denoised(before);
    TriangleMesh other = before;
    std::shuffle(other.triangles.begin(), other.triangles.end(), std::mt19937(1));
    for (std::size_t i = 0; i < other.triangles.size(); i += 3) {
        std::swap(other.triangles[i][0], other.triangles[i][1]);
    }
    EXPECT_EQ(report_of(other).volume_change, report_of(before).volume_change);
    other = denoised(other);
    other.triangles = after.triangles;
    EXPECT_TRUE(same_bits(other, after));
}

TEST(RemoveNoise, GivesTheSameBitsWithAnyNumberOfThreads) {
    const TriangleMesh before = with_noise(shapes::bumpy_sphere(40), 0.2);
    NoiseParameters parameters;
    parameters.threads = 1;
    const TriangleMesh after = denoised(before, parameters);
    for (const int threads : {2, 3, 8}) {
        parameters.threads = threads;
        EXPECT_TRUE(same_bits(denoised(before, parameters), after)) << threads;
    }
}

TEST(RemoveNoise, TakesASoupAsItsMesh) {
    const TriangleMesh before = with_noise(cube(), 0.2);
    const TriangleMesh after = denoised(before);
    TriangleMesh soup = denoised(shapes::soup(before));
    const double edge = mean_edge_length(before);
    EXPECT_LT(rms_distance(soup, shapes::soup(after)), 1e-3 * edge);
    // Outliers, so that these are counted, too.
    TriangleMesh noisy = cube();
    for (std::size_t i = 0; i < noisy.positions.size(); i += 5) {
        noisy.positions[i] = before.positions[i];
    }
    NoiseParameters parameters;
    parameters.largest_movement = 0.2 * edge;
    const NoiseReport of_mesh = report_of(noisy, parameters);
    const NoiseReport of_soup = report_of(shapes::soup(noisy), parameters);
    EXPECT_EQ(of_soup.vertices, of_mesh.vertices);
    EXPECT_EQ(of_soup.smoothing_steps, of_mesh.smoothing_steps);
    EXPECT_NEAR(static_cast<double>(of_soup.outliers), static_cast<double>(of_mesh.outliers), 2);
    EXPECT_NEAR(static_cast<double>(of_soup.bounded_vertices),
                static_cast<double>(of_mesh.bounded_vertices), 2);
    EXPECT_GT(of_mesh.bounded_vertices, 0);
    EXPECT_NEAR(of_soup.noise, of_mesh.noise, 1e-3 * edge);
    EXPECT_NEAR(of_soup.noise_size, of_mesh.noise_size, 1e-9);
    EXPECT_NEAR(of_soup.rms_displacement, of_mesh.rms_displacement, 1e-3 * edge);
    EXPECT_NEAR(of_soup.largest_displacement, of_mesh.largest_displacement, 1e-3 * edge);
    EXPECT_NEAR(of_soup.area_after, of_mesh.area_after, 1e-3);
    EXPECT_NEAR(of_soup.lost_area, of_mesh.lost_area, 1e-3);
}

}  // namespace
}  // namespace tracked_mcf
