// SPDX-License-Identifier: GPL-3.0-or-later
// Waves of every length keep the share of their height that the flow without elements leaves them.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <tuple>

#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

constexpr int kStepsOfWaves = 3;
const double kPi = std::acos(-1.0);

/// Returns the share of its height that a plane wave ideally keeps.
double ideal(double wave, double detail_size, int order) {
    const double k = 2 * kPi / wave;
    const double waves = step_size_for(detail_size, kStepsOfWaves, order) * k * k;
    return std::pow(1 - std::pow(waves / (1 + waves), order), kStepsOfWaves);
}

/// Returns the square [0, 180]² with edges of mean length 1, turned against the axes, and waves on
/// it.
TriangleMesh wavy_plane(double wave, const Eigen::Affine3d& turn) {
    TriangleMesh mesh = shapes::square(180);
    const double edge = mean_edge_length(mesh);
    for (Eigen::Vector3d& position : mesh.positions) {
        position /= edge;
        position.z() = 0.01 * std::min(wave, 10.0) * std::sin(2 * kPi * position.x() / wave);
        position = turn * position;
    }
    return mesh;
}

/// Order and detail size, in edges.
class Wavelengths : public testing::TestWithParam<std::tuple<int, double>> {};

TEST_P(Wavelengths, KeepTheirShareOfTheHeight) {
    const auto [order, detail_size] = GetParam();
    const Eigen::Affine3d turn(Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.3, 0.2, 1).normalized()));
    for (const double wave : {2.5, 3.3, 5.0, 8.0, 16.0, 32.0, 64.0}) {
        if (wave > std::max(2 * detail_size, 2.5)) continue;
        const TriangleMesh before = wavy_plane(wave, turn);
        TriangleMesh after = before;
        FlowParameters parameters;
        parameters.detail_size = detail_size;
        parameters.order = order;
        evolve(after, parameters);
        double kept = 0, squares = 0;
        const double side = 1 / mean_edge_length(shapes::square(180));
        for (std::size_t i = 0; i < before.positions.size(); ++i) {
            const Eigen::Vector3d from = turn.inverse() * before.positions[i];
            if (std::abs(from.x() / side - 0.5) > 0.25 || std::abs(from.y() / side - 0.5) > 0.25)
                continue;
            kept += from.z() * (turn.inverse() * after.positions[i]).z();
            squares += from.z() * from.z();
        }
        const double share = kept / squares, exact = ideal(wave, detail_size, order);
        std::printf("detail %g, order %d, wave %g: %.3f, ideal %.3f\n", detail_size, order, wave,
                    share, exact);
        if (detail_size < 4) {
            EXPECT_NEAR(share, exact, 0.07) << wave;  // the mesh's own limit
        } else if (wave < detail_size / 2) {
            EXPECT_LT(share, exact + 0.05) << wave;
            EXPECT_GT(share, exact - 0.01) << wave;
        } else if (wave >= detail_size) {
            EXPECT_NEAR(share, exact, 0.02 * exact) << wave;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(OrdersAndSizes, Wavelengths,
                         testing::Combine(testing::Values(1, 2, 3),
                                          testing::Values(2.5, 4.0, 8.0, 16.0, 32.0)));

}  // namespace
}  // namespace tracked_mcf
