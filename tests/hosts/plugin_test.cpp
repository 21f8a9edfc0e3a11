// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the real plugin, loaded as in the hosts of its release, without a display.

#include <gtest/gtest.h>

#include <QApplication>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/presentation/filter_names.h"
#include "tests/hosts/plugin_fixture.h"

namespace tracked_mcf {

namespace {

TEST_F(Plugin, DeclaresItselfAsAPreviewableSmoother) {
    const host::Declaration declaration = filter().declaration();
    EXPECT_EQ(filter().filters_in_plugin(), 3);
    EXPECT_EQ(declaration.name, kNames<FlowParameters>.name);
    EXPECT_TRUE(contains(declaration.help, kNames<FlowParameters>.help));
    EXPECT_TRUE(declaration.smooths);
    EXPECT_TRUE(declaration.takes_one_layer);
    EXPECT_EQ(declaration.requirements, MeshModel::MM_NONE);
    EXPECT_EQ(declaration.post_condition, MeshModel::MM_VERTCOORD | MeshModel::MM_VERTNORMAL |
                                              MeshModel::MM_FACENORMAL | MeshModel::MM_VERTQUALITY);
}

TEST_F(Plugin, NamesItsVersionInTheHelpAndTheLog) {
    const std::string build = "Filter Tracked MCF " TRACKED_MCF_VERSION;
    EXPECT_TRUE(contains(filter().declaration().help, build));
    ASSERT_TRUE(apply()) << outcome.message;
    EXPECT_TRUE(contains(outcome.log, build + ": Smoothed ")) << outcome.log;
}

TEST_F(Plugin, IsApplicableToFacesOnly) {
    EXPECT_TRUE(filter().is_applicable(layer));
    EXPECT_FALSE(filter().is_applicable(host::add_layer(document, "empty")));
}

/// Returns the rows of the table that dialogs and scripts offer.
std::vector<Parameter> offered_parameters() {
    const auto& table = parameter_table<FlowParameters>();
    std::vector<Parameter> rows(table.begin(), table.end());
    const auto is_hidden = [](const Parameter& parameter) { return parameter.label.empty(); };
    rows.erase(std::remove_if(rows.begin(), rows.end(), is_hidden), rows.end());
    const auto& inputs = input_table<FlowParameters>();
    rows.insert(rows.end(), inputs.begin(), inputs.end());
    return rows;
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

TEST_F(Plugin, ParametersAreThoseOfTheTable) {
    const RichParameterList defaults = filter().parameters(document);
    const std::vector<Parameter> rows = offered_parameters();
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

TEST_F(Plugin, EveryParameterOfTheTableIsRead) {
    for (const Parameter& row : offered_parameters()) {
        RichParameterList others;
        for (const RichParameter& parameter : parameters) {
            if (parameter.name().toStdString() != row.name) others.addParam(parameter);
        }
        outcome = filter().apply(document, others);
        EXPECT_FALSE(outcome.succeeded) << row.name;
        EXPECT_TRUE(contains(outcome.message, row.name + " is missing")) << outcome.message;
    }
}

TEST_F(Plugin, ParametersNeedNoLayer) {
    MeshDocument empty;
    const RichParameterList defaults = filter().parameters(empty);
    EXPECT_EQ(defaults.size(), offered_parameters().size());
    EXPECT_EQ(defaults.getParameterByName("detail_size").value().getFloat(), 0);
}

/// Returns the mean length of the sides of those faces.
double mean_edge(const MeshModel& layer, const std::function<bool(const CFaceO&)>& counts) {
    double sum = 0;
    int sides = 0;
    for (const CFaceO& face : layer.cm.face) {
        if (face.IsD() || !counts(face)) continue;
        for (int i = 0; i < 3; ++i, ++sides) sum += vcg::Distance(face.cP(i), face.cP((i + 1) % 3));
    }
    return sum / sides;
}

TEST_F(Plugin, TheDetailSizeIsAtFirstThatOfTheFacesThatWillFlow) {
    const auto at_first = [&] {
        const RichParameterList defaults = filter().parameters(document);
        return defaults.getParameterByName("detail_size").value().getFloat();
    };
    const auto is_selected = [](const CFaceO& face) { return face.IsS(); };
    const auto all = [](const CFaceO&) { return true; };
    // The inner faces of the torus are smaller.
    for (CFaceO& face : layer.cm.face) {
        const Point3m p = face.cP(0);
        std::hypot(p[0], p[1]) < 1.5 ? face.SetS() : face.ClearS();
    }
    EXPECT_LT(mean_edge(layer, is_selected), 0.9 * mean_edge(layer, all));
    EXPECT_NEAR(at_first(), kDefaultDetailInEdges * mean_edge(layer, is_selected), 1e-6);
    for (CFaceO& face : layer.cm.face) face.ClearS();
    EXPECT_NEAR(at_first(), kDefaultDetailInEdges * mean_edge(layer, all), 1e-6);
    delete_first_vertex(layer);
    EXPECT_NEAR(at_first(), kDefaultDetailInEdges * mean_edge(layer, all), 1e-6)
        << "deleted elements do not count";
    layer.cm.vert[17].P()[1] = std::numeric_limits<Scalarm>::quiet_NaN();
    EXPECT_EQ(at_first(), 0) << "the mesh cannot flow";
}

TEST_F(Plugin, ADetailSizeOfZeroIsTheOneAtFirst) {
    const auto original = layer.cm.vert;
    for (CFaceO& face : layer.cm.face) face.ClearS();
    parameters.setValue("detail_size",
                        filter().parameters(document).getParameterByName("detail_size").value());
    ASSERT_TRUE(apply()) << outcome.message;
    const auto first = layer.cm.vert;
    for (std::size_t i = 0; i < original.size(); ++i) layer.cm.vert[i].P() = original[i].cP();
    host::set_length(parameters, "detail_size", 0);
    ASSERT_TRUE(apply()) << outcome.message;
    for (std::size_t i = 0; i < original.size(); ++i) {
        EXPECT_LT(vcg::Distance(layer.cm.vert[i].cP(), first[i].cP()), 1e-6) << i;
    }
}

TEST_F(Plugin, MovesPositionsAndNothingElse) {
    const Belongings belongings(layer);
    const auto before = position_bits(layer);
    ASSERT_TRUE(apply()) << outcome.message;
    const auto after = position_bits(layer);
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_NE(before[i], after[i]) << i;
    EXPECT_TRUE(Belongings(layer) == belongings);
    EXPECT_TRUE(contains(outcome.log, "1800 vertices")) << outcome.log;
}

TEST_F(Plugin, WritesTheQualityThatIsAskedFor) {
    const auto quality = [&] {
        std::vector<double> numbers;
        for (const CVertexO& vertex : layer.cm.vert) numbers.push_back(vertex.cQ());
        return numbers;
    };
    for (CVertexO& vertex : layer.cm.vert) vertex.Q() = 42;
    layer.clearDataMask(MeshModel::MM_VERTQUALITY);
    const std::vector<double> before = quality();
    ASSERT_TRUE(apply()) << outcome.message;
    EXPECT_EQ(quality(), before);
    parameters.setValue("quality", *host::choice(1));
    ASSERT_TRUE(apply()) << outcome.message;
    const std::vector<double> displacement = quality();
    // The name of MeshLab's filter in all releases.
    EXPECT_TRUE(contains(outcome.log, "Colorize by vertex Quality")) << outcome.log;
    parameters.setValue("quality", *host::choice(2));
    ASSERT_TRUE(apply()) << outcome.message;
    EXPECT_NE(displacement, before);
    EXPECT_NE(quality(), displacement);
    EXPECT_TRUE(layer.hasDataMask(MeshModel::MM_VERTQUALITY));
}

TEST_F(Plugin, TakesTheStrengthFromTheQuality) {
    for (CVertexO& vertex : layer.cm.vert) vertex.Q() = vertex.cP()[0] > 0 ? 1 : 0;
    const std::vector<CVertexO> original(layer.cm.vert.begin(), layer.cm.vert.end());
    const auto before = position_bits(layer);
    parameters.setValue("strength", BoolValue(true));
    layer.clearDataMask(MeshModel::MM_VERTQUALITY);
    ASSERT_FALSE(apply()) << "the layer has no quality";
    EXPECT_TRUE(contains(outcome.message, "no vertex quality")) << outcome.message;
    layer.updateDataMask(MeshModel::MM_VERTQUALITY);
    ASSERT_TRUE(apply()) << outcome.message;
    EXPECT_TRUE(contains(outcome.log, " have strength 0.")) << outcome.log;
    const auto after = position_bits(layer);
    for (std::size_t i = 0; i < before.size(); ++i) {
        EXPECT_EQ(before[i] == after[i], original[i].cQ() == 0) << i;
        EXPECT_EQ(layer.cm.vert[i].cQ(), original[i].cQ()) << i;
    }
    layer.cm.vert[5].Q() = 2;
    ASSERT_FALSE(apply());
    EXPECT_TRUE(contains(outcome.message, "The strength of vertex 5 is 2.")) << outcome.message;
    EXPECT_EQ(position_bits(layer), after);
}

TEST_F(Plugin, SelectedIsOnAtFirstIfFacesAreSelected) {
    const auto is_on_at_first = [&] { return filter().parameters(document).getBool("selected"); };
    layer.cm.sfn = 0;
    EXPECT_TRUE(is_on_at_first()) << "whatever the counter says";
    for (CFaceO& face : layer.cm.face) face.ClearS();
    layer.cm.sfn = 17;
    EXPECT_FALSE(is_on_at_first());
    layer.cm.face[3].SetS();
    vcg::tri::Allocator<CMeshO>::DeleteFace(layer.cm, layer.cm.face[3]);
    EXPECT_FALSE(is_on_at_first()) << "by a deleted face";
}

TEST_F(Plugin, OnlySelectedFacesMove) {
    // Half of the torus.
    std::vector<bool> stays(layer.cm.vert.size(), false);
    for (CFaceO& face : layer.cm.face) {
        const bool selected = face.cV(0)->cP()[0] > 0;
        selected ? face.SetS() : face.ClearS();
        for (int corner = 0; !selected && corner < 3; ++corner) {
            stays[vcg::tri::Index(layer.cm, face.cV(corner))] = true;
        }
    }
    parameters.setValue("selected", BoolValue(true));
    const Belongings belongings(layer);
    const auto before = position_bits(layer);
    ASSERT_TRUE(apply()) << outcome.message;
    const auto after = position_bits(layer);
    for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(before[i] == after[i], stays[i]) << i;
    EXPECT_TRUE(Belongings(layer) == belongings);
    EXPECT_TRUE(contains(outcome.log, " vertices kept their positions.")) << outcome.log;

    // The same vertices move if the volume is preserved.
    const auto smoothed = position_bits(layer);
    parameters.setValue("preserve", *host::choice(2));
    ASSERT_TRUE(apply()) << outcome.message;
    const auto again = position_bits(layer);
    for (std::size_t i = 0; i < again.size(); ++i) {
        EXPECT_EQ(smoothed[i] == again[i], stays[i]) << i;
    }
}

TEST_F(Plugin, ABoundaryKeepsItsBits) {
    delete_first_vertex(layer);
    const Belongings belongings(layer);
    const auto before = position_bits(layer);
    ASSERT_TRUE(apply()) << outcome.message;
    const auto after = position_bits(layer);
    std::size_t kept = 0;
    for (std::size_t i = 1; i < before.size(); ++i) kept += before[i] == after[i] ? 1 : 0;
    EXPECT_EQ(kept, 6u) << "the neighbours of the vertex that is missing";
    EXPECT_TRUE(Belongings(layer) == belongings);
}

TEST_F(Plugin, AFlowThatVanishesSucceedsAndLogsIt) {
    parameters.setValue("step_size", FloatValue(1e3f));
    parameters.setValue("iterations", IntValue(100));
    const auto before = position_bits(layer);
    ASSERT_TRUE(apply()) << outcome.message;
    EXPECT_TRUE(contains(outcome.log, "Warning: ")) << outcome.log;
}

TEST_F(Plugin, UpdatesBoxAndNormals) {
    ASSERT_TRUE(apply());
    const Box3m box = layer.cm.bbox;
    const Point3m vertex_normal = layer.cm.vert[11].cN(), face_normal = layer.cm.face[11].cN();
    update_box_and_normals(layer);
    EXPECT_EQ(box, layer.cm.bbox);
    EXPECT_EQ(vertex_normal, layer.cm.vert[11].cN());
    EXPECT_EQ(face_normal, layer.cm.face[11].cN());
}

TEST_F(Plugin, DeletedElementsAreIgnored) {
    delete_first_vertex(layer);
    const Belongings belongings(layer);
    const auto before = position_bits(layer);
    ASSERT_TRUE(apply()) << outcome.message;
    EXPECT_EQ(position_bits(layer)[0], before[0]);
    EXPECT_TRUE(Belongings(layer) == belongings);

    MeshModel& compact = host::add_layer(document, "compact");
    make_layer(compact);
    delete_first_vertex(compact);
    vcg::tri::Allocator<CMeshO>::CompactEveryVector(compact.cm);
    ASSERT_TRUE(apply());
    const auto with_deleted = position_bits(layer);
    EXPECT_EQ(std::vector(with_deleted.begin() + 1, with_deleted.end()), position_bits(compact));
}

int last_percent = 0;

TEST_F(Plugin, ReportsProgressInPercent) {
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

TEST_F(Plugin, StopsWhenTheCallbackReturnsFalse) {
    const auto before = position_bits(layer);
    EXPECT_FALSE(apply([](int percent, const char*) { return percent < 50; }));
    EXPECT_EQ(position_bits(layer), before);
    EXPECT_TRUE(contains(outcome.message, "Stopped")) << outcome.message;
}

}  // namespace

}  // namespace tracked_mcf

int main(int argc, char** argv) {
    qputenv("QT_QPA_PLATFORM", "offscreen");
    QApplication application(argc, argv);
    testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
