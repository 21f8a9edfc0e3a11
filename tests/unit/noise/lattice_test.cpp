// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/lattice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/noise/labels_of_balls.h"
#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

std::optional<Lattice> lattice_of_mesh(const TriangleMesh& mesh) {
    const NoisySurface surface = surface_of_mesh(mesh);
    return lattice_of(surface, whole_of(surface));
}

/// Returns the lengths of the sides of a mesh's cells.
Eigen::Vector3d cells_of(const TriangleMesh& mesh) {
    const std::optional<Lattice> lattice = lattice_of_mesh(mesh);
    if (!lattice) return Eigen::Vector3d::Zero();
    return mean_edge_length(mesh) * lattice->cell.colwise().norm();
}

TEST(Lattice, OfFacesAndOfMarchingCubesHasTheirCells) {
    for (const double radius : {2.0, 3.0, 6.0}) {
        EXPECT_LT((cells_of(ball_of_faces(radius)) - Eigen::Vector3d::Ones()).norm(), 1e-6);
        EXPECT_LT((cells_of(ball_of_marching_cubes(radius)) - Eigen::Vector3d::Ones()).norm(),
                  1e-6);
    }
    EXPECT_FALSE(lattice_of_mesh(ball_of_faces(6))->is_marching);
    EXPECT_TRUE(lattice_of_mesh(ball_of_marching_cubes(6))->is_marching);
}

TEST(Lattice, MayBeOfSlicesTurnedAndSheared) {
    const Eigen::Vector3d sides(1, 1.25, 3);
    Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
    shear(0, 2) = 0.2;
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();
    for (const TriangleMesh& ball : {ball_of_faces(6), ball_of_marching_cubes(6)}) {
        for (const Eigen::Matrix3d& motion :
             {Eigen::Matrix3d(turn), Eigen::Matrix3d(turn * shear)}) {
            const Eigen::Matrix3d map = motion * sides.asDiagonal();
            Eigen::Vector3d expected = map.colwise().norm();
            Eigen::Vector3d found = cells_of(shapes::transformed(ball, Eigen::Affine3d(map)));
            std::sort(expected.begin(), expected.end());
            std::sort(found.begin(), found.end());
            EXPECT_LT((found - expected).norm(), 1e-6);
        }
    }
}

// A scanner has hundreds of slices.
TEST(Lattice, MayHaveManyPlanes) {
    const TriangleMesh ball = ball_of_marching_cubes(3);
    TriangleMesh balls;
    for (int i = 0; i < 60; ++i) {
        const Eigen::Translation3d by(Eigen::Vector3d::Constant(9 * i));
        balls = shapes::merged(balls, shapes::transformed(ball, Eigen::Affine3d(by)));
    }
    EXPECT_LT((cells_of(balls) - Eigen::Vector3d::Ones()).norm(), 1e-6);
}

TEST(Lattice, OfAveragedCellsIsSoft) {
    const Eigen::Vector3d sides(1, 1.25, 2);
    const TriangleMesh ball =
        shapes::transformed(averaged_ball(8), Eigen::Affine3d(sides.asDiagonal()));
    EXPECT_LT((cells_of(ball) - sides).norm(), 1e-6);
    EXPECT_TRUE(lattice_of_mesh(ball)->is_soft);
    EXPECT_FALSE(lattice_of_mesh(ball_of_marching_cubes(8))->is_soft);
    EXPECT_FALSE(lattice_of_mesh(averaged_ball(4))) << "it has too few vertices";
}

// Each has many vertices with two whole coordinates.
TEST(Lattice, IsNotThatOfSmoothFieldsOrNoise) {
    const TriangleMesh distances = shapes::marching_cubes(-12, 12, [](const Eigen::Vector3i& at) {
        return 0.5 + (8.3 - (at.cast<double>() + Eigen::Vector3d(0.31, 0.12, -0.23)).norm()) / 9;
    });
    EXPECT_FALSE(lattice_of_mesh(distances));
    const auto block = [](const Eigen::Vector3i& at) { return at.cwiseAbs().maxCoeff() < 8; };
    TriangleMesh noisy = shapes::voxels(-9, 9, block);
    for (std::size_t i = 0; i < noisy.positions.size(); ++i) {
        Eigen::Index side = 0;
        noisy.positions[i].cwiseAbs().maxCoeff(&side);
        noisy.positions[i][side] += 0.1 * std::sin(100.0 * static_cast<double>(i));
    }
    EXPECT_FALSE(lattice_of_mesh(noisy));
}

// Cells of 1 / 3, written with two decimals.
TEST(Lattice, SurvivesRoundedCoordinates) {
    TriangleMesh ball = ball_of_marching_cubes(6);
    for (Eigen::Vector3d& position : ball.positions)
        position = (position * (100 / 3.0)).array().round() / 100;
    EXPECT_LT((cells_of(ball) - Eigen::Vector3d::Constant(1 / 3.0)).norm(), 0.003);
}

TEST(Lattice, IsOnlyThatOfCells) {
    TriangleMesh raster = shapes::square(40);
    for (Eigen::Vector3d& position : raster.positions)
        position[2] = std::round(40 * position[0] * position[1]) / 80;
    for (const TriangleMesh& mesh :
         {raster, shapes::geodesic_sphere(12), shapes::torus(30, 20, 1, 0.4),
          with_noise(ball_of_faces(6), 0.2), shapes::split_in_four(ball_of_marching_cubes(4))}) {
        EXPECT_FALSE(lattice_of_mesh(mesh));
    }
}

TEST(Border, OfOtherCellsIsNotOnALattice) {
    const NoisySurface surface = surface_of_mesh(ball_of_faces(4));
    const PartRange whole = whole_of(surface);
    Lattice lattice = *lattice_of(surface, whole);
    EXPECT_TRUE(is_border(surface, whole, lattice));
    lattice.origin += 0.3 * lattice.cell.col(0);
    EXPECT_FALSE(is_border(surface, whole, lattice));
}

TEST(Lattice, NeedsAFewVertices) {
    EXPECT_FALSE(lattice_of_mesh(ball_of_faces(0.5)));
}

}  // namespace
}  // namespace tracked_mcf
