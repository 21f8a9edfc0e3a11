// SPDX-License-Identifier: GPL-3.0-or-later
// Our filter treats deleted, selected, transformed and hidden elements as MeshLab's Laplacian
// smoother.

#include <gtest/gtest.h>

#include <functional>

#include "tests/hosts/host.h"
#include "tests/hosts/layer.h"

namespace tracked_mcf {

namespace {

/// A smoother with the dialog's defaults.
class Smoother {
public:
    explicit Smoother(const std::string& plugin_file, const std::string& name = {})
        : filter_(plugin_file, name) {}

    void apply(MeshDocument& document) const {
        const host::Outcome outcome = filter_.apply(document, filter_.parameters(document));
        ASSERT_TRUE(outcome.succeeded) << outcome.message;
    }

private:
    host::Filter filter_;
};

const Smoother& stock() {
    static const Smoother smoother(TRACKED_MCF_STOCK_SMOOTHER_FILE, "Laplacian Smooth");
    return smoother;
}

const Smoother& ours() {
    static const Smoother smoother(TRACKED_MCF_PLUGIN_FILE);
    return smoother;
}

/// Two complete layers without a selection. The first is current.
struct Scene {
    Scene()
        : first(host::add_layer(document, "first")), second(host::add_layer(document, "second")) {
        for (MeshModel* layer : {&first, &second}) {
            make_layer(*layer);
            select(*layer, [](const CFaceO&) { return false; });
        }
        document.setCurrentMesh(first.id());
    }

    static void select(MeshModel& layer, const std::function<bool(const CFaceO&)>& wanted) {
        layer.cm.sfn = layer.cm.svn = 0;
        for (CVertexO& vertex : layer.cm.vert) vertex.ClearS();
        for (CFaceO& face : layer.cm.face) {
            wanted(face) ? face.SetS() : face.ClearS();
            if (face.IsS()) ++layer.cm.sfn;
        }
    }

    MeshDocument document;
    MeshModel& first;
    MeshModel& second;
};

using Bits = std::vector<PositionBits>;

struct Result {
    Bits first_before, first_after, second_before, second_after;

    std::vector<bool> moved_in_first() const {
        std::vector<bool> moved;
        moved.reserve(first_before.size());
        for (std::size_t i = 0; i < first_before.size(); ++i) {
            moved.push_back(first_before[i] != first_after[i]);
        }
        return moved;
    }
    std::ptrdiff_t moved_count() const {
        const std::vector<bool> moved = moved_in_first();
        return std::count(moved.begin(), moved.end(), true);
    }
};

/// Returns the scene after `prepare` and then the smoother.
Result result_of(const Smoother& smoother, const std::function<void(Scene&)>& prepare) {
    Scene scene;
    prepare(scene);
    Result result;
    result.first_before = position_bits(scene.first);
    result.second_before = position_bits(scene.second);
    smoother.apply(scene.document);
    result.first_after = position_bits(scene.first);
    result.second_after = position_bits(scene.second);
    return result;
}

TEST(AsTheStockSmoother, DeletedElementsStayAsTheyAre) {
    const auto prepare = [](Scene& scene) { delete_first_vertex(scene.first); };
    for (const Smoother* smoother : {&stock(), &ours()}) {
        const Result result = result_of(*smoother, prepare);
        EXPECT_FALSE(result.moved_in_first()[0]);
        EXPECT_GT(result.moved_count(), 1700);
    }
}

TEST(AsTheStockSmoother, OnlyVerticesInsideASelectionMove) {
    const auto prepare = [](Scene& scene) {
        Scene::select(scene.first, [](const CFaceO& face) { return face.cV(0)->cP()[0] > 0; });
    };
    const Result theirs = result_of(stock(), prepare), own = result_of(ours(), prepare);
    EXPECT_EQ(own.moved_in_first(), theirs.moved_in_first());
    EXPECT_GT(own.moved_count(), 500);
    EXPECT_LT(own.moved_count(), 1300);
}

TEST(AsTheStockSmoother, ATransformationMatrixIsIgnored) {
    const auto turn = [](Scene& scene) {
        vcg::Matrix44<Scalarm> matrix;
        matrix.SetRotateDeg(30, Point3m(1, 2, 3));
        scene.first.cm.Tr = matrix;
    };
    const auto reset = [](Scene& scene) { scene.first.cm.Tr.SetIdentity(); };
    for (const Smoother* smoother : {&stock(), &ours()}) {
        EXPECT_EQ(result_of(*smoother, turn).first_after, result_of(*smoother, reset).first_after);
    }
}

TEST(AsTheStockSmoother, AHiddenLayerStaysUnlessItIsCurrent) {
    const auto hide = [](Scene& scene) { host::hide(scene.second); };
    const auto hide_current = [](Scene& scene) {
        host::hide(scene.second);
        scene.document.setCurrentMesh(scene.second.id());
    };
    for (const Smoother* smoother : {&stock(), &ours()}) {
        const Result hidden = result_of(*smoother, hide);
        EXPECT_EQ(hidden.second_after, hidden.second_before);
        EXPECT_EQ(hidden.moved_count(), 1800);
        const Result current = result_of(*smoother, hide_current);
        EXPECT_EQ(current.first_after, current.first_before);
        EXPECT_NE(current.second_after, current.second_before);
    }
}

}  // namespace

}  // namespace tracked_mcf
