// SPDX-License-Identifier: GPL-3.0-or-later
// Tests what the real plugin refuses: with a message, and without a change.

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <utility>

#include "tests/hosts/plugin_fixture.h"

namespace tracked_mcf {

namespace {

TEST_F(Plugin, FailsWithAMessageIfThereIsNoLayer) {
    MeshDocument empty;
    outcome = filter().apply(empty, parameters);
    EXPECT_FALSE(outcome.succeeded);
    EXPECT_TRUE(contains(outcome.message, "no layer")) << outcome.message;
}

/// An invalid input: the change that makes it invalid, and a word of the expected message.
struct BadInput {
    const char* name;
    std::function<void(MeshModel&, RichParameterList&)> spoil;
    const char* word;
};

std::ostream& operator<<(std::ostream& stream, const BadInput& input) {
    return stream << input.name;
}

class PluginRefuses : public Plugin, public testing::WithParamInterface<BadInput> {};

TEST_P(PluginRefuses, WithAMessageAndLeavesTheLayerUnchanged) {
    GetParam().spoil(layer, parameters);
    const Belongings belongings(layer);
    const auto before = position_bits(layer);
    EXPECT_FALSE(apply());
    EXPECT_EQ(position_bits(layer), before);
    EXPECT_TRUE(Belongings(layer) == belongings);
    EXPECT_TRUE(contains(outcome.message, GetParam().word)) << outcome.message;
}

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Makes one parameter invalid.
template <class ValueType, class Number>
auto set(const char* name, Number value) {
    return [=](MeshModel&, RichParameterList& list) { list.setValue(name, ValueType(value)); };
}

auto set_detail_size(float value) {
    return
        [=](MeshModel&, RichParameterList& list) { host::set_length(list, "detail_size", value); };
}

/// Makes one coordinate invalid.
auto put(float value) {
    return [=](MeshModel& layer, RichParameterList&) { layer.cm.vert[17].P()[1] = value; };
}

auto set_choice(const char* name, int index) {
    return [=](MeshModel&, RichParameterList& list) { list.setValue(name, *host::choice(index)); };
}

void remove_everything(MeshModel& layer, RichParameterList&) {
    layer.cm.Clear();
}

void remove_faces(MeshModel& layer, RichParameterList&) {
    for (CFaceO& face : layer.cm.face) vcg::tri::Allocator<CMeshO>::DeleteFace(layer.cm, face);
}

void flatten_every_face(MeshModel& layer, RichParameterList&) {
    for (CFaceO& face : layer.cm.face) face.V(2) = face.V(1);
}

void break_a_face(MeshModel& layer, RichParameterList&) {
    layer.cm.face[3].V(1) = nullptr;
}

/// Replaces a parameter by one of the same name and another type.
template <class RichType, class Number>
auto replace(const char* name, Number value) {
    return [=](MeshModel&, RichParameterList& list) {
        RichParameterList other;
        for (const RichParameter& parameter : list) {
            if (parameter.name() != name) other.addParam(parameter);
        }
        other.addParam(RichType(name, value));
        list = other;
    };
}

void select_nothing(MeshModel& layer, RichParameterList& list) {
    for (CFaceO& face : layer.cm.face) face.ClearS();
    layer.cm.sfn = 17;  // hosts do not keep this counter up to date
    list.setValue("selected", BoolValue(true));
}

void preserve_the_area_of_a_selection(MeshModel&, RichParameterList& list) {
    list.setValue("selected", BoolValue(true));
    list.setValue("preserve", *host::choice(1));
}

void conformalize_an_open_volume(MeshModel& layer, RichParameterList& list) {
    vcg::tri::Allocator<CMeshO>::DeleteFace(layer.cm, layer.cm.face[7]);
    list.setValue("flow", *host::choice(1));
    list.setValue("boundary", *host::choice(1));
    list.setValue("preserve", *host::choice(2));
}

void preserve_the_volume_of_a_turned_face(MeshModel& layer, RichParameterList& list) {
    std::swap(layer.cm.face[7].V(0), layer.cm.face[7].V(1));
    list.setValue("preserve", *host::choice(2));
}

INSTANTIATE_TEST_SUITE_P(
    BadInputs, PluginRefuses,
    testing::Values(
        BadInput{"EmptyMesh", remove_everything, "empty"},
        BadInput{"NoFaces", remove_faces, "no faces"},
        BadInput{"NaNCoordinate", put(kNaN), "finite"},
        BadInput{"InfiniteCoordinate", put(-kInfinity), "finite"},
        BadInput{"AllFacesDegenerate", flatten_every_face, "degenerate"},
        BadInput{"FaceWithoutAVertex", break_a_face, "does not exist"},
        BadInput{"DepthNegative", set<IntValue>("depth", -1), "depth"},
        BadInput{"DepthTooLarge", set<IntValue>("depth", 13), "depth"},
        BadInput{"NoIterations", set<IntValue>("iterations", 0), "iterations"},
        BadInput{"TooManyIterations", set<IntValue>("iterations", 1000001), "iterations"},
        BadInput{"DetailSizeNegative", set_detail_size(-1.0f), "detail_size"},
        BadInput{"DetailSizeNaN", set_detail_size(kNaN), "detail_size"},
        BadInput{"DetailSizeInfinite", set_detail_size(kInfinity), "detail_size"},
        BadInput{"DetailSizeOfTheWrongType", replace<RichInt>("detail_size", 1), "detail_size"},
        BadInput{"OrderZero", set<IntValue>("order", 0), "order is 0; give 1 to 4"},
        BadInput{"OrderTooLarge", set<IntValue>("order", 5), "order is 5; give 1 to 4"},
        BadInput{"OrderOfTheWrongType", replace<RichBool>("order", true), "order is missing"},
        BadInput{"StepSizeNegative", set<FloatValue>("step_size", -1e-5f), "step_size"},
        BadInput{"StepSizeNaN", set<FloatValue>("step_size", kNaN), "step_size"},
        BadInput{"StepSizeInfinite", set<FloatValue>("step_size", kInfinity), "step_size"},
        BadInput{"BoundaryTooLarge", set_choice("boundary", 2), "boundary"},
        BadInput{"BoundaryNegative", set_choice("boundary", -1), "boundary"},
        BadInput{"FlowTooLarge", set_choice("flow", 2), "flow"},
        BadInput{"FlowNegative", set_choice("flow", -1), "flow"},
        BadInput{"PreserveTooLarge", set_choice("preserve", 3), "preserve"},
        BadInput{"PreserveNegative", set_choice("preserve", -1), "preserve"},
        BadInput{"QualityTooLarge", set_choice("quality", 3), "quality"},
        BadInput{"QualityNegative", set_choice("quality", -1), "quality"},
        BadInput{"NothingSelected", select_nothing, "No face is selected"},
        BadInput{"AreaOfASelection", preserve_the_area_of_a_selection, "Preserving the area"},
        BadInput{"ConformalizedOpenVolume", conformalize_an_open_volume, "open"},
        BadInput{"VolumeOfATurnedFace", preserve_the_volume_of_a_turned_face, "oriented"},
        BadInput{"SelectedOfTheWrongType", replace<RichInt>("selected", 1), "selected"},
        BadInput{"MethodTooLarge", set_choice("method", 2), "method"},
        BadInput{"MethodNegative", set_choice("method", -1), "method"},
        BadInput{"DepthOfTheWrongType", replace<RichFloat>("depth", 5.0F), "depth"}),
    [](const auto& test) { return std::string(test.param.name); });

}  // namespace

}  // namespace tracked_mcf
