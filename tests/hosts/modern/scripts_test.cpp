// SPDX-License-Identifier: GPL-3.0-or-later
// The names and results of the filter in MeshLab 2022.02 and later, and in PyMeshLab scripts.

#include <gtest/gtest.h>

#include "tests/hosts/host.h"
#include "tests/hosts/layer.h"

namespace tracked_mcf {

namespace {

const host::Filter& filter() {
    static const host::Filter filter(TRACKED_MCF_PLUGIN_FILE);
    return filter;
}

TEST(Hosts, GetTheReleaseAndPrecisionOfThePlugin) {
    EXPECT_EQ(filter().declaration().built_for, TRACKED_MCF_BUILT_FOR);
}

TEST(Scripts, KnowTheFilterByItsName) {
    EXPECT_EQ(filter().declaration().python_name, "apply_coord_mean_curvature_flow");
}

TEST(Scripts, GetResultsOfTypesThatPythonKnows) {
    MeshDocument document;
    MeshModel& layer = host::add_layer(document, "layer");
    make_layer(layer);
    RichParameterList parameters = filter().parameters(document);
    parameters.setValue("depth", IntValue(5));
    parameters.setValue("iterations", IntValue(3));
    parameters.setValue("selected", BoolValue(false));
    const auto outputs = filter().apply(document, parameters).outputs;

    EXPECT_GT(outputs.size(), 25u);
    for (const auto& [name, value] : outputs) {
        const auto type = value.type();
        EXPECT_TRUE(type == QVariant::Int || type == QVariant::Double) << name;
    }
    EXPECT_EQ(outputs.at("detail_size").type(), QVariant::Double);
    EXPECT_EQ(outputs.at("depth").toInt(), 5);
    EXPECT_EQ(outputs.at("iterations").toInt(), 3);
}

}  // namespace

}  // namespace tracked_mcf
