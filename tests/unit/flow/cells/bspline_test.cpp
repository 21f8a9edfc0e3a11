// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/cells/bspline.h"

#include <gtest/gtest.h>

#include <random>

namespace tracked_mcf {
namespace {

Eigen::Vector3d corner_position(int corner) {
    return {static_cast<double>(corner_bit(corner, 0)), static_cast<double>(corner_bit(corner, 1)),
            static_cast<double>(corner_bit(corner, 2))};
}

class AtRandomPoints : public testing::Test {
protected:
    Eigen::Vector3d point() { return {unit_(random_), unit_(random_), unit_(random_)}; }

private:
    std::mt19937 random_{7};
    std::uniform_real_distribution<double> unit_{0, 1};
};
using Bspline = AtRandomPoints;

TEST_F(Bspline, SumsToOneAndReproducesThePoint) {
    for (int i = 0; i < 100; ++i) {
        const Eigen::Vector3d p = point();
        const CornerValues values = bspline_values(p);
        Eigen::Vector3d combination = Eigen::Vector3d::Zero();
        for (int corner = 0; corner < 8; ++corner) {
            combination += values[corner] * corner_position(corner);
        }
        EXPECT_NEAR(values.sum(), 1, 1e-15);
        EXPECT_LT((combination - p).norm(), 1e-15);
    }
}

TEST_F(Bspline, IsOneAtItsOwnCornerAndZeroAtTheOthers) {
    for (int corner = 0; corner < 8; ++corner) {
        const CornerValues expected = CornerValues::Unit(corner);
        EXPECT_EQ(bspline_values(corner_position(corner)), expected);
    }
}

TEST_F(Bspline, ParentIsTheWeightedSumOfItsChildren) {
    for (int octant = 0; octant < 8; ++octant) {
        const auto weights = refinement_weights(octant);
        const Eigen::Vector3d in_child = point();
        const Eigen::Vector3d in_parent = 0.5 * (corner_position(octant) + in_child);
        const CornerValues refined = weights.transpose() * bspline_values(in_child);
        EXPECT_LT((bspline_values(in_parent) - refined).norm(), 1e-15);
    }
}

}  // namespace
}  // namespace tracked_mcf
