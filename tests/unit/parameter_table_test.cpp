// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/parameter_table.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/fair.h"
#include "filter_tracked_mcf/core/remove_noise.h"
#include "tests/support/shapes.h"
#include "tests/support/values_outside.h"

namespace tracked_mcf {
namespace {

/// Returns a value in the parameter's range that is not its default.
ParameterValue other_value(const Parameter& parameter) {
    const ParameterValue value = parameter.initial;
    if (const bool* const flag = std::get_if<bool>(&value)) return !*flag;
    if (const int* const number = std::get_if<int>(&value)) {
        return *number < parameter.range.largest ? *number + 1 : *number - 1;
    }
    return 0.5;
}

TEST(ParameterTable, ARowSetsItsMemberAndNoOther) {
    for (const auto& set : parameter_table<FlowParameters>()) {
        const ParameterValue value = other_value(set);
        FlowParameters parameters;
        set.set(parameters, value);
        EXPECT_NO_THROW(validate(parameters)) << set.name;
        for (const auto& other : parameter_table<FlowParameters>()) {
            EXPECT_EQ(other.get(parameters), &other == &set ? value : other.initial)
                << set.name << ' ' << other.name;
        }
    }
}

template <class Parameters>
void expect_different_names_and_one_member_of_each_input() {
    std::set<std::string> names;
    for (const auto& parameter : parameter_table<Parameters>()) {
        EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name;
    }
    for (const Input& input : input_table<Parameters>()) {
        EXPECT_TRUE(names.insert(input.name).second) << input.name;
        EXPECT_NE(input.of_faces == nullptr, input.of_vertices == nullptr) << input.name;
    }
}

TEST(ParameterTable, NamesDifferAndAnInputHasOneMember) {
    expect_different_names_and_one_member_of_each_input<FlowParameters>();
    expect_different_names_and_one_member_of_each_input<NoiseParameters>();
    expect_different_names_and_one_member_of_each_input<FairParameters>();
}

void run_with(TriangleMesh& mesh, const FlowParameters& parameters) {
    evolve(mesh, parameters);
}

void run_with(TriangleMesh& mesh, const NoiseParameters& parameters) {
    remove_noise(mesh, {}, parameters);
}

void run_with(TriangleMesh& mesh, const FairParameters& parameters) {
    Selection selected(mesh.triangles.size(), 1);
    selected.back() = 0;
    fair(mesh, selected, parameters);
}

template <class Parameters>
void expect_refused_outside_the_ranges() {
    const TriangleMesh mesh = shapes::bumpy_sphere(5);
    for (const ParameterOf<Parameters>& row : parameter_table<Parameters>()) {
        for (const ParameterValue& value : values_outside(row)) {
            Parameters parameters;
            row.set(parameters, value);
            TriangleMesh untouched = mesh;
            try {
                run_with(untouched, parameters);
                ADD_FAILURE() << row.name << " was accepted";
            } catch (const InvalidParameter& error) {
                EXPECT_EQ(std::string(error.what()).rfind(row.name + " is ", 0), 0U)
                    << error.what();
            }
            EXPECT_EQ(untouched.positions, mesh.positions);
        }
    }
}

TEST(ParameterTable, WhatIsOutsideTheRangesIsRefusedAndNamed) {
    expect_refused_outside_the_ranges<FlowParameters>();
    expect_refused_outside_the_ranges<NoiseParameters>();
    expect_refused_outside_the_ranges<FairParameters>();
}

TEST(ParameterTable, NamesTheValuesOfEachChoiceInTheirOrder) {
    const std::map<std::string, std::pair<ParameterValue, std::string>> labels = {
        {"flow", {static_cast<int>(FlowKind::Conformalized), "Conformalized"}},
        {"boundary", {static_cast<int>(BoundaryCondition::Free), "Free"}},
        {"preserve", {static_cast<int>(Preserve::Volume), "Volume"}},
        {"quality", {static_cast<int>(Quality::MeanCurvature), "Mean curvature"}},
        {"method", {static_cast<int>(Method::Paper), "Paper"}}};
    for (const auto& parameter : parameter_table<FlowParameters>()) {
        if (parameter.type != Parameter::Type::Choice || parameter.label.empty()) continue;
        const auto& [value, label] = labels.at(parameter.name);
        EXPECT_EQ(parameter.choices.at(static_cast<std::size_t>(std::get<int>(value))).label,
                  label);
        FlowParameters parameters;
        parameter.set(parameters, value);
        EXPECT_EQ(parameter.get(parameters), value) << parameter.name;
    }
}

TEST(ParameterTable, ANumberThatIsNoChoiceIsRefusedWithTheLabels) {
    for (const int index : {-1, 2, std::numeric_limits<int>::max()}) {
        FlowParameters parameters;
        parameters.boundary = static_cast<BoundaryCondition>(index);
        try {
            validate(parameters);
            ADD_FAILURE() << index << " was accepted";
        } catch (const InvalidParameter& error) {
            EXPECT_EQ(error.what(),
                      "boundary is " + std::to_string(index) + "; give 0 to 1: Locked, Free.");
        }
    }
}

TEST(ParameterTable, ANameHasTheSameLabelInAllDialogs) {
    for (const Parameter& noise : parameter_table<NoiseParameters>()) {
        for (const Parameter& flow : parameter_table<FlowParameters>()) {
            if (noise.name == flow.name) {
                EXPECT_EQ(noise.label, flow.label) << noise.name;
            }
        }
    }
}

}  // namespace
}  // namespace tracked_mcf
