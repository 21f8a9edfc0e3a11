// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the filter Remove Noise of the real plugin. What it shares with the other filter is tested
// in plugin_test.cpp.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/presentation/filter_names.h"
#include "tests/hosts/plugin_fixture.h"

namespace tracked_mcf {

namespace {

class RemoveNoise : public testing::Test {
protected:
    RemoveNoise()
        : filter_(TRACKED_MCF_PLUGIN_FILE, kNames<NoiseParameters>.name),
          layer(host::add_layer(document, "layer")) {
        make_layer(layer);
        parameters = filter_.parameters(document);
        parameters.setValue("selected", BoolValue(false));
    }

    bool apply() {
        outcome = filter_.apply(document, parameters);
        return outcome.succeeded;
    }

    /// Moves each vertex along its normal, by this much on average.
    void add_noise(double deviation) {
        update_box_and_normals(layer);
        std::mt19937 random(1);
        std::normal_distribution<double> noise(0, deviation);
        for (CVertexO& vertex : layer.cm.vert)
            vertex.P() += vertex.N().Normalize() * Scalarm(noise(random));
    }

    host::Filter filter_;
    MeshDocument document;
    MeshModel& layer;
    RichParameterList parameters;
    host::Outcome outcome{};
};

TEST_F(RemoveNoise, HasItsOwnNameHelpAndParameters) {
    const host::Declaration declaration = filter_.declaration();
    EXPECT_EQ(declaration.name, kNames<NoiseParameters>.name);
    EXPECT_TRUE(contains(declaration.help, kNames<NoiseParameters>.help));
    EXPECT_TRUE(declaration.smooths);
    EXPECT_TRUE(declaration.takes_one_layer);
    std::size_t shown = 0;
    for (const Parameter& row : parameter_table<NoiseParameters>()) {
        if (row.label.empty()) continue;
        ++shown;
        ASSERT_TRUE(parameters.hasParameter(QString::fromStdString(row.name))) << row.name;
        const auto& rich = parameters.getParameterByName(QString::fromStdString(row.name));
        EXPECT_EQ(rich.fieldDescription().toStdString(), row.label);
        if (row.type == Parameter::Type::Length) {
            EXPECT_EQ(rich.value().getFloat(), 0) << row.name;
        }
    }
    for (const Input& input : input_table<NoiseParameters>()) {
        ++shown;
        EXPECT_TRUE(parameters.hasParameter(QString::fromStdString(input.name))) << input.name;
    }
    EXPECT_EQ(parameters.size(), shown);
}

TEST_F(RemoveNoise, MovesTheSurfaceTowardsTheOneWithoutNoiseAndChangesNothingElse) {
    // The layer is a torus with bumps finer than its edges, which are noise, too.
    const auto distance = [&] {
        double squares = 0;
        for (const CVertexO& vertex : layer.cm.vert) {
            const Point3m p = vertex.cP();
            const double height = std::hypot(std::hypot(p[0], p[1]) - 2, p[2]) - 1;
            squares += height * height;
        }
        return std::sqrt(squares / double(layer.cm.vert.size()));
    };
    add_noise(0.02);
    const double noisy = distance();
    const Belongings belongings(layer);
    ASSERT_TRUE(apply()) << outcome.message;
    EXPECT_LT(distance(), 0.5 * noisy);
    EXPECT_TRUE(Belongings(layer) == belongings);
    EXPECT_TRUE(contains(outcome.log, ": Removed noise from 1800 vertices")) << outcome.log;
}

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

TEST_F(RemoveNoise, UsesTheSelectionTheStrengthAndTheQuality) {
    add_noise(0.02);
    const auto original = layer.cm.vert;
    for (CFaceO& face : layer.cm.face) {
        std::hypot(face.cP(0)[0], face.cP(0)[1]) < 1.5 ? face.SetS() : face.ClearS();
    }
    parameters.setValue("selected", BoolValue(true));
    auto before = position_bits(layer);
    ASSERT_TRUE(apply()) << outcome.message;
    auto after = position_bits(layer);
    EXPECT_TRUE(after != before);
    for (const CFaceO& face : layer.cm.face) {
        if (face.IsD() || face.IsS()) continue;
        for (int corner = 0; corner < 3; ++corner) {
            const auto i = std::size_t(face.cV(corner) - &layer.cm.vert[0]);
            EXPECT_EQ(after[i], before[i]) << "a vertex of a face that is not selected";
        }
    }
    for (std::size_t i = 0; i < original.size(); ++i) layer.cm.vert[i].P() = original[i].cP();
    parameters.setValue("selected", BoolValue(false));
    parameters.setValue("strength", BoolValue(true));
    for (CVertexO& vertex : layer.cm.vert) vertex.Q() = vertex.cP()[0] < 0 ? 0 : 1;
    before = position_bits(layer);
    ASSERT_TRUE(apply()) << outcome.message;
    after = position_bits(layer);
    for (std::size_t i = 0; i < original.size(); ++i) {
        EXPECT_EQ(after[i] == before[i], original[i].cP()[0] < 0) << i;
    }

    parameters.setValue("strength", BoolValue(false));
    parameters.setValue("quality", *host::choice(1));
    ASSERT_TRUE(apply()) << outcome.message;
    const auto moved = [](const CVertexO& vertex) { return vertex.cQ() != 0; };
    EXPECT_GT(std::count_if(layer.cm.vert.begin(), layer.cm.vert.end(), moved), 1700);
}

}  // namespace

}  // namespace tracked_mcf
