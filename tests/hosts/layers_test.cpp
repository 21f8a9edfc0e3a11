// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the filter in a document with two layers.

#include "tests/hosts/plugin_fixture.h"

namespace tracked_mcf {

namespace {

/// A second layer of another size, with other faces selected. Both are visible, and the second is
/// the current one.
class Layers : public Plugin {
protected:
    Layers() : second(host::add_layer(document, "second")) { make_second(second); }

    static void make_second(MeshModel& layer) {
        make_layer(layer);
        for (CVertexO& vertex : layer.cm.vert) vertex.P() *= 3;
        for (CFaceO& face : layer.cm.face) face.ClearS();
        update_box_and_normals(layer);
    }
    /// Applies the filter with the dialog's defaults for the current layer.
    void apply_with_defaults(MeshDocument& to) {
        RichParameterList defaults = filter().parameters(to);
        defaults.setValue("depth", IntValue(4));
        outcome = filter().apply(to, defaults);
        ASSERT_TRUE(outcome.succeeded) << outcome.message;
    }

    MeshModel& second;
};

/// All that the filter may change in its layer, and must not change in another.
struct State {
    explicit State(const MeshModel& layer)
        : positions(position_bits(layer)), belongings(layer), box(layer.cm.bbox) {
        for (const CVertexO& vertex : layer.cm.vert) normals.push_back(vertex.cN());
        for (const CFaceO& face : layer.cm.face) normals.push_back(face.cN());
    }
    bool operator==(const State& other) const {
        return positions == other.positions && belongings == other.belongings && box == other.box &&
               normals == other.normals;
    }

    std::vector<PositionBits> positions;
    Belongings belongings;
    Box3m box;
    std::vector<Point3m> normals;
};

TEST_F(Layers, OnlyTheCurrentOneChangesEvenIfItIsHidden) {
    host::hide(layer);  // the current one in the end
    parameters.setValue("quality", *host::choice(1));
    const State first_before(layer), second_before(second);
    ASSERT_TRUE(apply()) << outcome.message;
    EXPECT_TRUE(State(layer) == first_before);
    EXPECT_FALSE(State(second) == second_before);

    const State second_after(second);
    document.setCurrentMesh(layer.id());
    ASSERT_TRUE(apply()) << outcome.message;
    EXPECT_TRUE(State(second) == second_after);
    EXPECT_FALSE(State(layer) == first_before);
}

TEST_F(Layers, TheResultIsThatOfALayerAlone) {
    MeshDocument alone_first, alone_second;
    MeshModel& first = host::add_layer(alone_first, "first");
    make_layer(first);
    apply_with_defaults(alone_first);
    make_second(host::add_layer(alone_second, "second"));
    apply_with_defaults(alone_second);

    apply_with_defaults(document);
    document.setCurrentMesh(layer.id());
    apply_with_defaults(document);
    EXPECT_TRUE(State(layer) == State(first));
    EXPECT_TRUE(State(second) == State(*alone_second.mm()));
}

TEST_F(Layers, TheDefaultsAreThoseOfTheCurrentOne) {
    // The first layer has selected faces, the second has none.
    const auto detail_size = [&] {
        return filter().parameters(document).getParameterByName("detail_size").value().getFloat();
    };
    const auto diagonal = [&] {
        const RichParameterList defaults = filter().parameters(document);
        return dynamic_cast<const RichLength&>(defaults.getParameterByName("detail_size")).max;
    };
    for (CFaceO& face : layer.cm.face) face.SetS();
    const Scalarm of_second = detail_size();
    EXPECT_EQ(diagonal(), second.cm.bbox.Diag());
    EXPECT_FALSE(filter().parameters(document).getBool("selected"));
    document.setCurrentMesh(layer.id());
    EXPECT_NEAR(detail_size(), of_second / 3, 1e-6 * of_second);
    EXPECT_EQ(diagonal(), layer.cm.bbox.Diag());
    EXPECT_TRUE(filter().parameters(document).getBool("selected"));
}

}  // namespace

}  // namespace tracked_mcf
