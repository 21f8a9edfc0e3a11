// SPDX-License-Identifier: GPL-3.0-or-later
// Tests what the real plugin refuses: with a message, and without a change.

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <utility>

#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/presentation/filter_names.h"
#include "tests/hosts/plugin_fixture.h"
#include "tests/support/values_outside.h"

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

/// Makes one coordinate invalid.
auto put(float value) {
    return [=](MeshModel& layer, RichParameterList&) { layer.cm.vert[17].P()[1] = value; };
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

INSTANTIATE_TEST_SUITE_P(
    BadInputs, PluginRefuses,
    testing::Values(
        BadInput{"NaNCoordinate", put(kNaN), "finite"},
        BadInput{"InfiniteCoordinate", put(-kInfinity), "finite"},
        BadInput{"FaceWithoutAVertex", break_a_face, "does not exist"},
        BadInput{"DetailSizeOfTheWrongType", replace<RichInt>("detail_size", 1), "detail_size"},
        BadInput{"OrderOfTheWrongType", replace<RichBool>("order", true), "order is missing"},
        BadInput{"NothingSelected", select_nothing, "No face is selected"},
        BadInput{"SelectedOfTheWrongType", replace<RichInt>("selected", 1), "selected"},
        BadInput{"DepthOfTheWrongType", replace<RichFloat>("depth", 5.0F), "depth"}),
    [](const auto& test) { return std::string(test.param.name); });

/// Sets a parameter to a value of its type.
void set(RichParameterList& list, const Parameter& row, const ParameterValue& value) {
    const QString name = QString::fromStdString(row.name);
    if (row.type == Parameter::Type::Choice) {
        list.setValue(name, *host::choice(std::get<int>(value)));
    } else if (row.type == Parameter::Type::Integer) {
        list.setValue(name, IntValue(std::get<int>(value)));
    } else if (row.type == Parameter::Type::Length) {
        host::set_length(list, name, static_cast<float>(std::get<double>(value)));
    } else {
        list.setValue(name, FloatValue(static_cast<float>(std::get<double>(value))));
    }
}

template <class Parameters>
void expect_refused_outside_the_ranges(MeshDocument& document) {
    const host::Filter filter(TRACKED_MCF_PLUGIN_FILE, kNames<Parameters>.name);
    const auto before = position_bits(*document.mm());
    for (const ParameterOf<Parameters>& row : parameter_table<Parameters>()) {
        if (row.label.empty()) continue;
        for (const ParameterValue& value : values_outside(row)) {
            RichParameterList parameters = filter.parameters(document);
            set(parameters, row, value);
            const host::Outcome outcome = filter.apply(document, parameters);
            EXPECT_FALSE(outcome.succeeded) << row.name;
            EXPECT_EQ(outcome.message.rfind(row.name + " is ", 0), 0U) << outcome.message;
            EXPECT_TRUE(contains(outcome.message, row.label)) << outcome.message;
        }
    }
    EXPECT_EQ(position_bits(*document.mm()), before);
}

TEST_F(Plugin, WhatIsOutsideTheRangesIsRefusedAndNamed) {
    expect_refused_outside_the_ranges<FlowParameters>(document);
    expect_refused_outside_the_ranges<NoiseParameters>(document);
    expect_refused_outside_the_ranges<FairParameters>(document);
}

}  // namespace

}  // namespace tracked_mcf
