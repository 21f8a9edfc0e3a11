// SPDX-License-Identifier: GPL-3.0-or-later
// Tests what only Mean Curvature Flow does, in the real plugin, which is loaded as in the hosts of
// its release, without a display. each_filter_test.cpp tests what all filters do.

#include <gtest/gtest.h>

#include <QApplication>
#include <cmath>
#include <functional>
#include <limits>

#include "tests/hosts/plugin_fixture.h"

namespace tracked_mcf {

namespace {

TEST_F(Plugin, IsApplicableToFacesOnly) {
    EXPECT_TRUE(filter().is_applicable(layer));
    EXPECT_FALSE(filter().is_applicable(host::add_layer(document, "empty")));
}

TEST_F(Plugin, ParametersNeedNoLayer) {
    MeshDocument empty;
    const RichParameterList defaults = filter().parameters(empty);
    EXPECT_EQ(defaults.getParameterByName("detail_size").value().getFloat(), 0);
}

/// Returns the mean length of the sides of those faces.
double mean_edge(const MeshModel& layer, const std::function<bool(const CFaceO&)>& counts) {
    double sum = 0;
    int sides = 0;
    for (const CFaceO& face : layer.cm.face) {
        if (face.IsD() || !counts(face)) continue;
        for (int i = 0; i < 3; ++i, ++sides) sum += vcg::Distance(face.cP(i), face.cP((i + 1) % 3));
    }
    return sum / sides;
}

TEST_F(Plugin, TheDetailSizeIsAtFirstThatOfTheFacesThatWillFlow) {
    const auto at_first = [&] {
        const RichParameterList defaults = filter().parameters(document);
        return defaults.getParameterByName("detail_size").value().getFloat();
    };
    const auto is_selected = [](const CFaceO& face) { return face.IsS(); };
    const auto all = [](const CFaceO&) { return true; };
    // The inner faces of the torus are smaller.
    for (CFaceO& face : layer.cm.face) {
        const Point3m p = face.cP(0);
        std::hypot(p[0], p[1]) < 1.5 ? face.SetS() : face.ClearS();
    }
    EXPECT_LT(mean_edge(layer, is_selected), 0.9 * mean_edge(layer, all));
    EXPECT_NEAR(at_first(), kDefaultDetailInEdges * mean_edge(layer, is_selected), 1e-6);
    for (CFaceO& face : layer.cm.face) face.ClearS();
    EXPECT_NEAR(at_first(), kDefaultDetailInEdges * mean_edge(layer, all), 1e-6);
    delete_first_vertex(layer);
    EXPECT_NEAR(at_first(), kDefaultDetailInEdges * mean_edge(layer, all), 1e-6)
        << "deleted elements do not count";
    layer.cm.vert[17].P()[1] = std::numeric_limits<Scalarm>::quiet_NaN();
    EXPECT_EQ(at_first(), 0) << "the mesh cannot flow";
}

TEST_F(Plugin, AFlowThatVanishesSucceedsAndLogsIt) {
    parameters.setValue("step_size", FloatValue(1e3f));
    parameters.setValue("iterations", IntValue(100));
    const auto before = position_bits(layer);
    ASSERT_TRUE(apply()) << outcome.message;
    EXPECT_TRUE(contains(outcome.log, "Warning: ")) << outcome.log;
}

}  // namespace

}  // namespace tracked_mcf

int main(int argc, char** argv) {
    qputenv("QT_QPA_PLATFORM", "offscreen");
    QApplication application(argc, argv);
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
