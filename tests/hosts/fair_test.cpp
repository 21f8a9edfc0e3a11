// SPDX-License-Identifier: GPL-3.0-or-later
// Tests what only Fair Selected Faces does, in the real plugin.

#include <gtest/gtest.h>

#include "tests/hosts/plugin_fixture.h"

namespace tracked_mcf {

namespace {

class Fair : public Plugin {
protected:
    Fair() : Plugin(kNames<FairParameters>.name) {}
};

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
