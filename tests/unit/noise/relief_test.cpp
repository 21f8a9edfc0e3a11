// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/relief.h"

#include <gtest/gtest.h>

#include <cmath>

#include "filter_tracked_mcf/core/noise/lattice.h"
#include "tests/unit/noise/labels_of_balls.h"
#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

TriangleMesh low_hills() {
    return raster(
        60, [](double x, double y) { return 1.6 * std::sin(0.13 * x) * std::sin(0.11 * y + 0.3); });
}

Relief relief_of_mesh(const TriangleMesh& mesh) {
    const NoisySurface surface = surface_of_mesh(mesh);
    return relief_of(surface, whole_of(surface));
}

TEST(Relief, FacesToOneSide) {
    const TriangleMesh hills = low_hills();
    const Eigen::Affine3d turn(Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()));
    EXPECT_TRUE(relief_of_mesh(hills).is_relief);
    EXPECT_TRUE(relief_of_mesh(shapes::transformed(hills, turn)).is_relief);
    EXPECT_LT(relief_of_mesh(hills).longest_edge, 2);
    for (const TriangleMesh& mesh : {ball_of_faces(6), ball_of_marching_cubes(6), cube()})
        EXPECT_FALSE(relief_of_mesh(mesh).is_relief);
}

TEST(Relief, IsNoBorderOfCells) {
    const NoisySurface surface = surface_of_mesh(low_hills());
    EXPECT_FALSE(lattice_of(surface, whole_of(surface)));
}

}  // namespace
}  // namespace tracked_mcf
