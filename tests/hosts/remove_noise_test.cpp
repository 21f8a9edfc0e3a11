// SPDX-License-Identifier: GPL-3.0-or-later
// Tests what only Remove Noise does, in the real plugin.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/hosts/plugin_fixture.h"

namespace tracked_mcf {

namespace {

class RemoveNoise : public Plugin {
protected:
    RemoveNoise() : Plugin(kNames<NoiseParameters>.name) {}

    /// Moves each vertex along its normal, by this much on average.
    void add_noise(double deviation) {
        update_box_and_normals(layer);
        std::mt19937 random(1);
        std::normal_distribution<double> noise(0, deviation);
        for (CVertexO& vertex : layer.cm.vert)
            vertex.P() += vertex.N().Normalize() * Scalarm(noise(random));
    }
};

TEST_F(RemoveNoise, MovesNoVertexFartherThanTheBound) {
    add_noise(0.02);
    const auto before = layer.cm.vert;
    const float bound = 0.01F;
    host::set_length(parameters, "largest_movement", bound);
    ASSERT_TRUE(apply()) << outcome.message;
    double largest = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        double square = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double moved = double(layer.cm.vert[i].cP()[axis]) - double(before[i].cP()[axis]);
            square += moved * moved;
        }
        largest = std::max(largest, std::sqrt(square));
    }
    EXPECT_LE(largest, double(bound)) << "after rounding to the layer's precision";
    EXPECT_GT(largest, 0.999 * double(bound)) << "some vertices reach the bound";
}

}  // namespace

}  // namespace tracked_mcf
