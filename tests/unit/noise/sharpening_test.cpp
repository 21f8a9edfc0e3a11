// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/sharpening.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

constexpr double kAnywhere = std::numeric_limits<double>::infinity();

/// Returns positions after so many iterations.
Positions sharpened(const NoisySurface& surface, const Positions& start, int iterations) {
    Positions result;
    sharpen(surface, 0.4, {iterations}, kAnywhere, confinement(surface.positions), start,
            [&](std::size_t, Positions positions) { result = std::move(positions); });
    return result;
}

TEST(Sharpening, KeepsACube) {
    const NoisySurface surface = surface_of_mesh(cube());
    const Positions positions = sharpened(surface, surface.positions, 5);
    for (std::size_t i = 0; i < positions.size(); ++i)
        EXPECT_LT((positions[i] - surface.positions[i]).norm(), 1e-12) << i;
}

TEST(Sharpening, LeavesAPlaneFlatAndItsFixedVerticesWhereTheyAre) {
    NoisySurface surface = surface_of_mesh(shapes::square(10));
    surface.fidelity[17] = 0;
    Positions positions = surface.positions;
    positions[17][2] += 0.1;
    const Eigen::Vector3d fixed = positions[17];
    EXPECT_EQ(sharpened(surface, positions, 5)[17], fixed);
}

TEST(Sharpening, TurnsTheNormalsOfANoisyCubeTowardsItsFaces) {
    const NoisySurface surface = surface_of_mesh(with_noise(cube(), 0.1));
    Positions positions = surface.positions;
    const auto error = [&] {
        double squares = 0;
        for (const Triangle& t : surface.stars.triangles) {
            const auto [a, b, c] = corners_of(positions, t);
            const double cosine = twice_vector_area(a, b, c).normalized().cwiseAbs().maxCoeff();
            squares += 1 - cosine * cosine;
        }
        return std::sqrt(squares);
    };
    Smoothing smoothing(surface);
    ASSERT_TRUE(smoothing.step({5, 1, 2, kAnywhere}, confinement(positions), positions));
    const double before = error();
    const Positions smooth = positions;
    positions = sharpened(surface, smooth, 10);
    EXPECT_LT(error(), 0.5 * before);

    // More than one number of iterations share the first ones.
    std::vector<Positions> both;
    sharpen(surface, 0.4, {4, 10}, kAnywhere, confinement(surface.positions), smooth,
            [&](std::size_t, Positions result) { both.push_back(std::move(result)); });
    EXPECT_EQ(both, (std::vector<Positions>{sharpened(surface, smooth, 4), positions}));
}

}  // namespace
}  // namespace tracked_mcf
