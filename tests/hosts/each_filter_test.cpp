// SPDX-License-Identifier: GPL-3.0-or-later
// Tests what all filters of the real plugin do alike.

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "filter_tracked_mcf/core/parameter_table.h"
#include "tests/hosts/plugin_fixture.h"

namespace tracked_mcf {

namespace {

/// A filter's names, and the rows of its table that dialogs and scripts offer.
struct OfferedFilter {
    FilterNames names;
    std::vector<Parameter> rows;
};

template <class Parameters>
OfferedFilter offered() {
    OfferedFilter filter{kNames<Parameters>, {}};
    for (const Parameter& row : parameter_table<Parameters>()) {
        if (!row.label.empty()) filter.rows.push_back(row);
    }
    for (const Input& input : input_table<Parameters>()) {
        if (!input.label.empty()) filter.rows.push_back(input);
    }
    return filter;
}

class EachFilter : public Plugin, public testing::WithParamInterface<OfferedFilter> {
protected:
    EachFilter() : Plugin(GetParam().names.name) {}
};

INSTANTIATE_TEST_SUITE_P(, EachFilter,
                         testing::Values(offered<FlowParameters>(), offered<NoiseParameters>(),
                                         offered<FairParameters>()),
                         [](const auto& test) {
                             std::string name = test.param.names.name;
                             name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
                             return name;
                         });

TEST_P(EachFilter, DeclaresItselfAsAPreviewableSmoother) {
    const host::Declaration declaration = filter(name).declaration();
    EXPECT_EQ(filter(name).filters_in_plugin(), 3);
    EXPECT_EQ(declaration.name, GetParam().names.name);
    EXPECT_TRUE(contains(declaration.help, GetParam().names.help));
    EXPECT_TRUE(declaration.smooths);
    EXPECT_TRUE(declaration.takes_one_layer);
    EXPECT_EQ(declaration.requirements, MeshModel::MM_NONE);
    EXPECT_EQ(declaration.post_condition, MeshModel::MM_VERTCOORD | MeshModel::MM_VERTNORMAL |
                                              MeshModel::MM_FACENORMAL | MeshModel::MM_VERTQUALITY);
}

TEST_P(EachFilter, NamesItsVersionInTheHelpAndTheLog) {
    const std::string build = "Filter Tracked MCF " TRACKED_MCF_VERSION;
    EXPECT_TRUE(contains(filter(name).declaration().help, build));
    select_half();
    ASSERT_TRUE(apply()) << outcome.message;
    EXPECT_TRUE(contains(outcome.log, build + ": ")) << outcome.log;
}

/// Expects a parameter of the plugin to have the default, the range and the labels of its row.
void expect_row(const RichParameter& actual, const Parameter& row, Scalarm diagonal) {
    const ParameterValue initial = row.initial;
    switch (row.type) {
        case Parameter::Type::Switch:
            ASSERT_EQ(actual.stringType(), "RichBool");
            if (row.name == "selected") break;  // on if faces are selected
            EXPECT_EQ(ParameterValue(actual.value().getBool()), initial);
            break;
        case Parameter::Type::Integer:
            ASSERT_EQ(actual.stringType(), "RichInt");
            EXPECT_EQ(ParameterValue(actual.value().getInt()), initial);
            break;
        case Parameter::Type::Real:
            ASSERT_EQ(actual.stringType(), "RichFloat");
            EXPECT_EQ(actual.value().getFloat(), Scalarm(std::get<double>(initial)));
            break;
        case Parameter::Type::Length: {
            ASSERT_EQ(actual.stringType(), "RichAbsPerc");
            const auto& length = dynamic_cast<const RichLength&>(actual);
            EXPECT_EQ(length.min, 0);
            EXPECT_EQ(length.max, diagonal);
            break;
        }
        case Parameter::Type::Choice: {
            ASSERT_EQ(actual.stringType(), "RichEnum");
            EXPECT_EQ(ParameterValue(choice_of(actual.value())), initial);
            QStringList labels;
            for (const NamedChoice& choice : row.choices) {
                labels << QString::fromStdString(choice.label);
            }
            EXPECT_EQ(dynamic_cast<const RichEnum&>(actual).enumvalues, labels);
        }
    }
}

TEST_P(EachFilter, ParametersAreThoseOfTheTable) {
    const RichParameterList defaults = filter(name).parameters(document);
    const std::vector<Parameter>& rows = GetParam().rows;
    ASSERT_EQ(defaults.size(), rows.size());
    for (unsigned int i = 0; i < defaults.size(); ++i) {
        const Parameter& row = rows[i];
        EXPECT_EQ(defaults.at(i).name().toStdString(), row.name);
        EXPECT_EQ(defaults.at(i).fieldDescription().toStdString(), row.label);
        // HTML, which MeshLab wraps. No help needs escapes.
        EXPECT_EQ(defaults.at(i).toolTip().toStdString(), "<span>" + row.help + "</span>");
        expect_row(defaults.at(i), row, layer.cm.bbox.Diag());
    }
}

TEST_P(EachFilter, EveryParameterOfTheTableIsRead) {
    for (const Parameter& row : GetParam().rows) {
        RichParameterList others;
        for (const RichParameter& parameter : parameters) {
            if (parameter.name().toStdString() != row.name) others.addParam(parameter);
        }
        outcome = filter(name).apply(document, others);
        EXPECT_FALSE(outcome.succeeded) << row.name;
        EXPECT_TRUE(contains(outcome.message, row.name + " is missing")) << outcome.message;
    }
}

TEST_P(EachFilter, MovesOnlySelectedFacesAndNothingElse) {
    const std::vector<bool> stays = select_half();
    if (parameters.hasParameter("selected")) parameters.setValue("selected", BoolValue(true));
    const Belongings belongings(layer);
    const auto before = position_bits(layer);
    ASSERT_TRUE(apply()) << outcome.message;
    const auto after = position_bits(layer);
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(before[i] == after[i], stays[i]) << i;
    EXPECT_TRUE(Belongings(layer) == belongings);
}

TEST_P(EachFilter, WritesTheQualityThatIsAskedFor) {
    const auto quality = [&] {
        std::vector<double> numbers;
        for (const CVertexO& vertex : layer.cm.vert) numbers.push_back(vertex.cQ());
        return numbers;
    };
    select_half();
    for (CVertexO& vertex : layer.cm.vert) vertex.Q() = 42;
    layer.clearDataMask(MeshModel::MM_VERTQUALITY);
    const std::vector<double> before = quality();
    ASSERT_TRUE(apply()) << outcome.message;
    EXPECT_EQ(quality(), before);
    parameters.setValue("quality", *host::choice(1));
    ASSERT_TRUE(apply()) << outcome.message;
    const std::vector<double> displacement = quality();
    EXPECT_NE(displacement, before);
    // The name of MeshLab's filter in all releases.
    EXPECT_TRUE(contains(outcome.log, "Colorize by vertex Quality")) << outcome.log;
    EXPECT_TRUE(layer.hasDataMask(MeshModel::MM_VERTQUALITY));
    if (name != kNames<FlowParameters>.name) return;
    parameters.setValue("quality", *host::choice(2));
    ASSERT_TRUE(apply()) << outcome.message;
    EXPECT_NE(quality(), displacement);
}

TEST_P(EachFilter, TakesTheStrengthFromTheQuality) {
    if (!parameters.hasParameter("strength")) return;
    for (CVertexO& vertex : layer.cm.vert) vertex.Q() = vertex.cP()[0] > 0 ? 1 : 0;
    const std::vector<CVertexO> original(layer.cm.vert.begin(), layer.cm.vert.end());
    const auto before = position_bits(layer);
    parameters.setValue("strength", BoolValue(true));
    layer.clearDataMask(MeshModel::MM_VERTQUALITY);
    ASSERT_FALSE(apply()) << "the layer has no quality";
    EXPECT_TRUE(contains(outcome.message, "no vertex quality")) << outcome.message;
    layer.updateDataMask(MeshModel::MM_VERTQUALITY);
    ASSERT_TRUE(apply()) << outcome.message;
    const auto after = position_bits(layer);
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_EQ(before[i] == after[i], original[i].cQ() == 0) << i;
        EXPECT_EQ(layer.cm.vert[i].cQ(), original[i].cQ()) << i;
    }
    layer.cm.vert[5].Q() = 2;
    ASSERT_FALSE(apply());
    EXPECT_TRUE(contains(outcome.message, "The strength of vertex 5 is 2;")) << outcome.message;
    EXPECT_EQ(position_bits(layer), after);
}

TEST_P(EachFilter, UpdatesBoxAndNormals) {
    select_half();
    ASSERT_TRUE(apply());
    const Box3m box = layer.cm.bbox;
    const Point3m vertex_normal = layer.cm.vert[11].cN(), face_normal = layer.cm.face[11].cN();
    update_box_and_normals(layer);
    EXPECT_EQ(box, layer.cm.bbox);
    EXPECT_EQ(vertex_normal, layer.cm.vert[11].cN());
    EXPECT_EQ(face_normal, layer.cm.face[11].cN());
}

TEST_P(EachFilter, DeletedElementsAndTheTransformationAreIgnored) {
    select_half();
    delete_first_vertex(layer);
    const Belongings belongings(layer);
    const auto before = position_bits(layer);
    ASSERT_TRUE(apply()) << outcome.message;
    EXPECT_EQ(position_bits(layer)[0], before[0]);
    EXPECT_TRUE(Belongings(layer) == belongings);

    MeshModel& compact = host::add_layer(document, "compact");
    make_layer(compact);
    compact.cm.Tr.SetIdentity();
    for (std::size_t i = 0; i < compact.cm.face.size(); ++i)
        layer.cm.face[i].IsS() ? compact.cm.face[i].SetS() : compact.cm.face[i].ClearS();
    delete_first_vertex(compact);
    vcg::tri::Allocator<CMeshO>::CompactEveryVector(compact.cm);
    ASSERT_TRUE(apply());
    const auto with_deleted = position_bits(layer);
    EXPECT_EQ(std::vector(with_deleted.begin() + 1, with_deleted.end()), position_bits(compact));
}

int last_percent = 0;

TEST_P(EachFilter, ReportsProgressInPercent) {
    select_half();
    last_percent = 0;
    ASSERT_TRUE(apply([](int percent, const char* phase) {
        EXPECT_LE(last_percent, percent);
        EXPECT_LE(percent, 100);
        EXPECT_STRNE(phase, "");
        last_percent = percent;
        return true;
    }));
    EXPECT_EQ(last_percent, 100);
}

TEST_P(EachFilter, StopsWhenTheCallbackReturnsFalse) {
    select_half();
    const auto before = position_bits(layer);
    EXPECT_FALSE(apply([](int percent, const char*) { return percent < 50; }));
    EXPECT_EQ(position_bits(layer), before);
    EXPECT_TRUE(contains(outcome.message, "Stopped")) << outcome.message;
}

}  // namespace

}  // namespace tracked_mcf
