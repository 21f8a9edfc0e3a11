// SPDX-License-Identifier: GPL-3.0-or-later
// Tests what a user can do while the filter runs: MeshLab's progress callback processes events.

#include <functional>
#include <memory>
#include <thread>
#include <utility>

#include "tests/hosts/plugin_fixture.h"

namespace tracked_mcf {

namespace {

/// The percentage at which the user acts. 100 is that of the last callback.
class Running : public Plugin, public testing::WithParamInterface<int> {
protected:
    bool apply_meanwhile(std::function<void()> act) {
        action = std::move(act);
        action_percent = GetParam();
        const bool succeeded = apply(process_events);
        EXPECT_FALSE(action) << "the user did not act";
        return succeeded;
    }
    /// Expects that the run fails, says why, and leaves the layer as the action has left it.
    void expect_refusal_after(const std::function<void()>& act, const std::string& word) {
        std::vector<PositionBits> left;
        EXPECT_FALSE(apply_meanwhile([&] {
            act();
            left = position_bits(layer);
        }));
        EXPECT_TRUE(contains(outcome.message, word)) << outcome.message;
        EXPECT_EQ(position_bits(layer), left);
    }
    /// Returns the bits that the filter gives the layer of the fixture if nobody interferes.
    std::vector<PositionBits> undisturbed() {
        MeshDocument other;
        MeshModel& same = host::add_layer(other, "same");
        make_layer(same);
        EXPECT_TRUE(filter().apply(other, parameters).succeeded);
        return position_bits(same);
    }
};

TEST_P(Running, ANewerRunReplacesTheFirst) {
    RichParameterList newer = parameters;
    newer.setValue("iterations", IntValue(3));
    MeshDocument other;
    MeshModel& same = host::add_layer(other, "same");
    make_layer(same);
    ASSERT_TRUE(filter().apply(other, newer).succeeded);
    const auto before = position_bits(layer);
    const Belongings belongings(layer);
    ASSERT_TRUE(apply_meanwhile([&] {
        filter().parameters(document);  // the user opens the dialog again
        const host::Outcome inner = filter().apply(document, newer, process_events);
        EXPECT_TRUE(inner.succeeded) << inner.message;
        EXPECT_EQ(inner.log, "");
        EXPECT_EQ(position_bits(layer), before);
        EXPECT_TRUE(Belongings(layer) == belongings);
    })) << outcome.message;
    EXPECT_EQ(position_bits(layer), position_bits(same));
    EXPECT_TRUE(Belongings(layer) == belongings);
}

TEST_P(Running, TheNewestOfManyRunsIsMade) {
    const auto expected = undisturbed();
    RichParameterList newer = parameters;
    newer.setValue("iterations", IntValue(1));
    ASSERT_TRUE(apply_meanwhile([&] {
        // The second arrives while the run of the first has begun.
        EXPECT_TRUE(filter().apply(document, newer, process_events).succeeded);
        action = [&] {
            EXPECT_TRUE(filter().apply(document, newer, process_events).succeeded);
            EXPECT_TRUE(filter().apply(document, parameters, process_events).succeeded);
        };
    })) << outcome.message;
    EXPECT_EQ(position_bits(layer), expected);
}

TEST_P(Running, ANewerRunWithWrongParametersFails) {
    RichParameterList wrong = parameters;
    wrong.setValue("depth", IntValue(-1));
    const auto before = position_bits(layer);
    EXPECT_FALSE(apply_meanwhile(
        [&] { EXPECT_TRUE(filter().apply(document, wrong, process_events).succeeded); }));
    EXPECT_TRUE(contains(outcome.message, "depth")) << outcome.message;
    EXPECT_EQ(position_bits(layer), before);
}

TEST_P(Running, ANewerRunIsForTheLayerThatIsThenTheCurrentOne) {
    const auto expected = undisturbed();
    MeshModel& other = host::add_layer(document, "other");
    make_layer(other);
    document.setCurrentMesh(layer.id());
    const auto before = position_bits(layer);
    ASSERT_TRUE(apply_meanwhile([&] {
        document.setCurrentMesh(other.id());
        EXPECT_TRUE(filter().apply(document, parameters, process_events).succeeded);
    })) << outcome.message;
    EXPECT_EQ(position_bits(layer), before) << "the layer that was current at first";
    EXPECT_EQ(position_bits(other), expected);
}

TEST_P(Running, AnotherFilterOrDocumentIsRefusedAndTheFirstGoesOn) {
    const auto expected = undisturbed();
    const host::Filter noise(TRACKED_MCF_PLUGIN_FILE, "Remove Noise");
    MeshDocument other_document;
    MeshModel& far = host::add_layer(other_document, "far");
    make_layer(far);
    const auto before = position_bits(far);
    ASSERT_TRUE(apply_meanwhile([&] {
        for (const host::Outcome& inner :
             {noise.apply(document, noise.parameters(document), process_events),
              filter().apply(other_document, parameters, process_events)}) {
            EXPECT_FALSE(inner.succeeded);
            EXPECT_TRUE(contains(inner.message, "already running")) << inner.message;
            EXPECT_TRUE(contains(inner.message, "goes on when")) << inner.message;
        }
    })) << outcome.message;
    EXPECT_EQ(position_bits(layer), expected);
    EXPECT_EQ(position_bits(far), before);
}

TEST_P(Running, AnotherRunWorksAfterTheFirstHasEnded) {
    const auto before = position_bits(layer);
    EXPECT_FALSE(apply([](int, const char*) { return false; }));
    RichParameterList invalid = parameters;
    invalid.setValue("depth", IntValue(-1));
    EXPECT_FALSE(filter().apply(document, invalid).succeeded);
    EXPECT_EQ(position_bits(layer), before);
    const auto expected = undisturbed();
    EXPECT_TRUE(apply()) << outcome.message;
    EXPECT_EQ(position_bits(layer), expected);
}

TEST_P(Running, ARunOfAnotherThreadIsNotRefused) {
    const auto expected = undisturbed();
    MeshDocument other_document;
    MeshModel& other = host::add_layer(other_document, "other");
    make_layer(other);
    ASSERT_TRUE(apply_meanwhile([&] {
        std::thread([&] {
            EXPECT_TRUE(filter().apply(other_document, parameters).succeeded);
        }).join();
    })) << outcome.message;
    EXPECT_EQ(position_bits(other), expected);
    EXPECT_EQ(position_bits(layer), expected);
}

TEST_P(Running, ALayerWithoutItsDeletedElementsIsTheSame) {
    delete_first_vertex(layer);
    MeshDocument other;
    MeshModel& same = host::add_layer(other, "same");
    make_layer(same);
    delete_first_vertex(same);
    ASSERT_TRUE(filter().apply(other, parameters).succeeded);
    vcg::tri::Allocator<CMeshO>::CompactEveryVector(same.cm);
    // MeshLab 2020.09 does this after each run, even after one that is refused.
    ASSERT_TRUE(apply_meanwhile([&] { vcg::tri::Allocator<CMeshO>::CompactEveryVector(layer.cm); }))
        << outcome.message;
    EXPECT_EQ(position_bits(layer), position_bits(same));
}

TEST_P(Running, AMovedVertexIsKept) {
    expect_refusal_after([&] { layer.cm.vert[3].P()[1] += Scalarm(1e-3); }, "changed");
}

TEST_P(Running, VerticesInAnotherOrderAreKept) {
    // Each vertex keeps its faces, so the surface is the same.
    const auto swap_vertices = [&] {
        CMeshO& mesh = layer.cm;
        std::swap(mesh.vert[3].P(), mesh.vert[4].P());
        for (CFaceO& face : mesh.face) {
            for (int i = 0; i < 3; ++i) {
                const std::size_t vertex = vcg::tri::Index(mesh, face.V(i));
                if (vertex == 3 || vertex == 4) face.V(i) = &mesh.vert[7 - vertex];
            }
        }
    };
    expect_refusal_after(swap_vertices, "changed");
}

TEST_P(Running, AnAddedVertexIsKept) {
    const auto add = [&] { vcg::tri::Allocator<CMeshO>::AddVertex(layer.cm, Point3m(0, 0, 0)); };
    expect_refusal_after(add, "changed");
}

TEST_P(Running, ATurnedFaceIsKept) {
    expect_refusal_after([&] { std::swap(layer.cm.face[3].V(0), layer.cm.face[3].V(1)); },
                         "changed");
}

TEST_P(Running, ADeletedLayerEndsTheRun) {
    MeshModel& other = host::add_layer(document, "other");
    make_layer(other);
    const auto before = position_bits(other);
    document.setCurrentMesh(layer.id());
    EXPECT_FALSE(apply_meanwhile([&] { host::delete_layer(document, layer); }));
    EXPECT_TRUE(contains(outcome.message, "deleted")) << outcome.message;
    EXPECT_EQ(position_bits(other), before);
}

TEST_P(Running, AClosedDocumentEndsTheRun) {
    auto closed = std::make_unique<MeshDocument>();
    make_layer(host::add_layer(*closed, "layer"));
    action = [&] { closed.reset(); };
    action_percent = GetParam();
    outcome = filter().apply(*closed, parameters, process_events);
    EXPECT_FALSE(closed);
    EXPECT_FALSE(outcome.succeeded);
    EXPECT_TRUE(contains(outcome.message, "deleted")) << outcome.message;
}

INSTANTIATE_TEST_SUITE_P(Percent, Running, testing::Values(0, 50, 100));

}  // namespace

}  // namespace tracked_mcf
