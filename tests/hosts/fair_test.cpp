// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the filter Fair Selected Faces of the real plugin. What it shares with the other filters is
// tested in plugin_test.cpp.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/presentation/filter_names.h"
#include "tests/hosts/plugin_fixture.h"

namespace tracked_mcf {

namespace {

class Fair : public testing::Test {
protected:
    Fair()
        : filter_(TRACKED_MCF_PLUGIN_FILE, kNames<FairParameters>.name),
          layer(host::add_layer(document, "layer")) {
        make_layer(layer);
        parameters = filter_.parameters(document);
        for (CFaceO& face : layer.cm.face) {
            face.cP(0)[0] > 2 ? face.SetS() : face.ClearS();
        }
    }

    bool apply() {
        outcome = filter_.apply(document, parameters);
        return outcome.succeeded;
    }

    host::Filter filter_;
    MeshDocument document;
    MeshModel& layer;
    RichParameterList parameters;
    host::Outcome outcome{};
};

TEST_F(Fair, HasItsOwnNameHelpAndParameters) {
    const host::Declaration declaration = filter_.declaration();
    EXPECT_EQ(declaration.name, kNames<FairParameters>.name);
    EXPECT_TRUE(contains(declaration.help, kNames<FairParameters>.help));
    EXPECT_TRUE(declaration.smooths);
    EXPECT_TRUE(declaration.takes_one_layer);
    std::size_t shown = 0;
    for (const Parameter& row : parameter_table<FairParameters>()) {
        if (row.label.empty()) continue;
        ++shown;
        ASSERT_TRUE(parameters.hasParameter(QString::fromStdString(row.name))) << row.name;
        const auto& rich = parameters.getParameterByName(QString::fromStdString(row.name));
        EXPECT_EQ(rich.fieldDescription().toStdString(), row.label);
    }
    EXPECT_EQ(parameters.size(), shown);
}

TEST_F(Fair, MovesTheInnerVerticesOfTheSelectionAndChangesNothingElse) {
    std::vector<char> outside(layer.cm.vert.size(), 0);
    for (const CFaceO& face : layer.cm.face) {
        if (face.IsD() || face.IsS()) continue;
        for (int corner = 0; corner < 3; ++corner) {
            outside[std::size_t(face.cV(corner) - &layer.cm.vert[0])] = 1;
        }
    }
    const auto before = position_bits(layer);
    const Belongings belongings(layer);
    ASSERT_TRUE(apply()) << outcome.message;
    const auto after = position_bits(layer);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < outside.size(); ++i) {
        if (outside[i] != 0) {
            EXPECT_EQ(after[i], before[i]) << i;
        } else if (after[i] != before[i]) {
            ++moved;
        }
    }
    EXPECT_GT(moved, 100);
    EXPECT_TRUE(Belongings(layer) == belongings);
    EXPECT_TRUE(contains(outcome.log, ": Faired ")) << outcome.log;
}

TEST_F(Fair, ShowsTheDisplacementAsQuality) {
    parameters.setValue("quality", *host::choice(1));
    ASSERT_TRUE(apply()) << outcome.message;
    const auto moved = [](const CVertexO& vertex) { return vertex.cQ() != 0; };
    EXPECT_GT(std::count_if(layer.cm.vert.begin(), layer.cm.vert.end(), moved), 100);
}

TEST_F(Fair, SaysWhatToSelect) {
    const auto before = position_bits(layer);
    for (CFaceO& face : layer.cm.face) face.SetS();
    EXPECT_FALSE(apply());
    EXPECT_TRUE(contains(outcome.message, "nothing around")) << outcome.message;
    for (CFaceO& face : layer.cm.face) face.ClearS();
    EXPECT_FALSE(apply());
    EXPECT_TRUE(contains(outcome.message, "No face is selected")) << outcome.message;
    for (CFaceO& face : layer.cm.face) {
        if (face.IsD()) continue;
        face.SetS();
        break;
    }
    EXPECT_TRUE(apply());
    EXPECT_EQ(position_bits(layer), before);
}

}  // namespace

}  // namespace tracked_mcf
