// SPDX-License-Identifier: GPL-3.0-or-later
// Tests summaries and warnings.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "filter_tracked_mcf/presentation/flow_warnings.h"
#include "filter_tracked_mcf/presentation/noise_warnings.h"
#include "filter_tracked_mcf/presentation/report_table.h"
#include "filter_tracked_mcf/presentation/summary.h"
#include "filter_tracked_mcf/presentation/surface_warnings.h"

namespace tracked_mcf {

namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(Summary, HasAFactInEachLine) {
    FlowParameters parameters;
    FlowReport report;
    report.vertices = 100;
    report.triangles = 196;
    report.seconds = 1.25;
    EXPECT_EQ(summary(parameters, report),
              "Smoothed 100 vertices by 0 steps of mean-curvature flow in 1.2 s.");
    report.steps.resize(10);
    report.detail_size = 0.5;
    report.largest_displacement = 0.1234567;
    report.rms_displacement = 0.0625;
    report.area_before = 8;
    report.area_after = 7;
    report.volume_before = 2;
    report.volume_change = 0;
    const std::string moved = "Vertices moved by up to 0.123, RMS 0.0625.\nArea: -12.5 %. Volume: ";
    EXPECT_EQ(summary(parameters, report),
              "Smoothed 100 vertices by 10 steps of mean-curvature flow in 1.2 s.\n"
              "Detail smaller than 0.5 was removed.\n" +
                  moved + "unchanged.");
    parameters.flow = FlowKind::Conformalized;
    report.stop = Stop::Pinched;  // not all of the detail is gone
    report.volume_change = 0.25;
    report.unselected_triangles = 4;
    report.held_vertices = 12;
    report.degenerate_triangles = 1;
    report.copied_triangles = 2;
    EXPECT_EQ(summary(parameters, report),
              "Smoothed 100 vertices by 10 steps of conformalized mean-curvature flow in 1.2 s.\n" +
                  moved +
                  "+12.5 %.\n"
                  "Only the 196 selected of 200 faces could move.\n"
                  "12 vertices kept their positions.\n"
                  "1 face with zero area had no influence.\n"
                  "2 faces are copies of others, and did not count again.");
}

TEST(Summary, TellsTheVolumeOfASurfaceThatEnclosesNone) {
    FlowReport report;
    report.steps.resize(1);
    report.area_before = report.area_after = 1;
    report.volume_change = -0.25;
    EXPECT_THAT(summary({}, report), EndsWith("Volume swept along the normals: -0.25."));
    report.volume_change = kNoNumber;
    EXPECT_THAT(summary({}, report), HasSubstr("Volume: unknown, because the faces cannot be"));
    report.volume_change = -0.25;
    report.volume_before = -2;  // normals that point inwards
    EXPECT_THAT(summary({}, report), EndsWith("Volume: +12.5 %."));
}

TEST(Summary, TellsWhereTheDetailSizeHolds) {
    FlowParameters parameters;
    FlowReport report;
    report.steps.resize(1);
    report.detail_size = 3;
    EXPECT_THAT(summary(parameters, report), HasSubstr("\nDetail smaller than 3 was removed."));
    report.has_strengths = true;
    EXPECT_THAT(summary(parameters, report), HasSubstr("\nWhere the strength is 1, detail"));
}

TEST(Summary, OfNoiseHasAFactInEachLine) {
    NoiseReport report;
    report.vertices = 100;
    report.seconds = 0.123;
    NoiseParameters parameters;
    report.stop = NoiseStop::NoNoise;
    EXPECT_EQ(summary(parameters, report), "Found no noise to remove from 100 vertices in 0.12 s.");
    report.stop = NoiseStop::TooManyCreases;
    EXPECT_EQ(summary(parameters, report), "Removed no noise from 100 vertices in 0.12 s.");
    report.stop = NoiseStop::None;
    report.kind = NoiseKind::White;
    report.smoothing_steps = 2;
    report.largest_displacement = 0.1;
    report.rms_displacement = 0.02;
    report.cracks.joined_vertices = 2;
    report.noise = 0.01234;
    report.outliers = 3;
    report.crease_share = 0.0567;
    report.detail_size = 0.25;
    report.area_before = report.area_after = report.volume_before = 1;
    report.volume_change = 0;
    report.bounded_vertices = 7;
    EXPECT_EQ(
        summary(parameters, report),
        "Removed noise from 100 vertices in 0.12 s.\n"
        "The noise along the normals was about 0.0123.\n"
        "3 vertices had so much more than others that they hardly counted.\n"
        "Creases cross 5.67 % of the area.\n"
        "Elsewhere, detail smaller than 0.25 was removed.\n"
        "Vertices moved by up to 0.1, RMS 0.02.\nArea: unchanged. Volume: unchanged.\n"
        "7 vertices moved as far as the largest movement allows.\n"
        "Cracks were closed: 2 vertices count as one with another that is nearer than 1e-6 of "
        "the diagonal.");
    report.boundary_edges = 5;
    parameters.boundary = NoiseBoundary::Smooth;
    EXPECT_THAT(summary(parameters, report), HasSubstr("The rim was smoothed, too."));
    report.kind = NoiseKind::Shared;
    EXPECT_THAT(summary(parameters, report), HasSubstr("0.0123, shared by neighbouring"));
    report.kind = NoiseKind::Varying;
    EXPECT_THAT(summary(parameters, report), HasSubstr("0.0123, and more in some places"));
    report.kind = NoiseKind::Stairs;
    EXPECT_THAT(summary(parameters, report), HasSubstr("0.0123, in stairs."));
    report.cell_x = report.cell_y = 1;
    report.cell_z = 4;
    EXPECT_THAT(summary(parameters, report), HasSubstr("sides 1, 1 and 4 were smoothed."));
    report.kind = NoiseKind::None;
    EXPECT_THAT(summary(parameters, report), HasSubstr("Smoothed the rim of 100 vertices"));
}

TEST(NoiseWarnings, SayWhyNothingWasRemovedAndWhatToDo) {
    const auto warning = [](const NoiseReport& report) {
        const std::vector<std::string> warnings = warnings_of(NoiseParameters(), report);
        EXPECT_EQ(warnings.size(), 1U);
        return warnings.empty() ? std::string() : warnings.front();
    };
    NoiseReport report;
    EXPECT_TRUE(warnings_of(NoiseParameters(), report).empty());
    report.stop = NoiseStop::TooFewVertices;
    EXPECT_THAT(warning(report), HasSubstr("Nothing has moved: fewer than 100 vertices"));
    report.stop = NoiseStop::TooManyCreases;
    report.crease_share = 0.998;
    report.median_turn = 7;
    EXPECT_THAT(warning(report), HasSubstr("creases cross 100 % of the area"));
    EXPECT_THAT(warning(report), HasSubstr("Give a crease angle of more than 7°"));
    report.stop = NoiseStop::NoNoise;
    EXPECT_THAT(warning(report), HasSubstr("switch on Lumps, too"));
    report.stairs = 3;
    EXPECT_THAT(warning(report), HasSubstr("but stairs 3 high"));
    report.largest_displacement = 1;
    EXPECT_THAT(warning(report), HasSubstr("No noise was removed: ")) << "the rim has moved";
    report.stop = NoiseStop::ModelledPart;
    report.flat_edges = 0.38;
    EXPECT_THAT(warning(report), HasSubstr("38 % of the edges are exactly flat"));
    report = {};
    report.kind = NoiseKind::Stairs;
    report.stairs = 3;
    report.noise_size = 4.5;
    EXPECT_THAT(warning(report), HasSubstr("stairs 3 high, as of heights in whole numbers"));
    EXPECT_THAT(warning(report), HasSubstr("They were smoothed as noise that is 4.5 wide."));
    report.cell_x = 2;
    EXPECT_THAT(warning(report), HasSubstr("Stairs 3 high, as of voxels or slices, were smoothed"));
    report.kind = NoiseKind::None;
    report.stop = NoiseStop::NoNoise;
    EXPECT_THAT(warning(report), HasSubstr("stay: they may be the shape"));
    report = {};
    NoiseParameters given;
    given.noise_size = report.noise_size = 4;
    report.noise = 1;
    report.rms_displacement = 0.2;
    EXPECT_THAT(warnings_of(given, report),
                testing::ElementsAre(HasSubstr("Hardly any noise of the size 4 was removed.")));
    report.noise_size = std::nextafter(4, 5);
    EXPECT_FALSE(warnings_of(given, report).empty()) << "edges times sizes in edges round";
    report.rms_displacement = 0.6;
    EXPECT_TRUE(warnings_of(given, report).empty());
    report = {};
    report.shrunken_parts = 2;
    report.lost_area = 0.12;
    report.lost_volume = 0.4;
    report.turned_triangles = 7;
    EXPECT_THAT(warning(report),
                HasSubstr("2 parts of the surface have lost more than noise: up to 12 % of their "
                          "area, up to 40 % of change in their volume, 7 faces turned over."));
    report.kept_parts = 2;
    EXPECT_THAT(warning(report), HasSubstr("2 parts of the surface stay as they were"));
    report = {};
    report.kind = NoiseKind::Shared;
    report.noise_size = 2;
    report.noise = 0.25;
    EXPECT_THAT(warning(report), HasSubstr("much the same noise, about 2 wide and 0.25 high"));
    NoiseParameters wished;
    wished.lumps = true;
    EXPECT_THAT(warnings_of(wished, report),
                testing::ElementsAre(HasSubstr("Lumps and waves about 2 wide")));
    report = {};
    report.stop = NoiseStop::NoNoise;
    wished = {};
    wished.noise = 1e-12;
    EXPECT_THAT(warnings_of(wished, report),
                testing::ElementsAre(HasSubstr("farther than noise of 1e-12")));
    report = {};
    report.cracks.open_pairs = 33;
    report.cracks.open_width = 2e-4;
    EXPECT_THAT(warning(report), HasSubstr("33 pairs of rim vertices are up to 0.0002 apart"));
}

TEST(EarlyStop, NamesTheStepTheReasonAndTheRemedy) {
    FlowParameters parameters;
    parameters.iterations = 10;
    FlowReport report;
    const auto early_stop = [&] {
        const std::vector<std::string> warnings = warnings_of(parameters, report);
        return warnings.empty() ? "" : warnings.front();
    };
    EXPECT_EQ(early_stop(), "");
    report.stop = Stop::Vanished;
    EXPECT_EQ(early_stop(),
              "Nothing has moved: the first step would have left no surface. Take a smaller detail "
              "size or step size.");
    report.stop = Stop::NotPreserved;
    EXPECT_EQ(early_stop(),
              "Nothing has moved: step 1 would have changed the surface so much that its volume "
              "cannot be restored. Take more steps, or a smaller detail size or step size.");
    report.stop = Stop::StepFailed;
    EXPECT_EQ(
        early_stop(),
        "Nothing has moved: step 1 failed: the surface left its bounds, or the equations could "
        "not be solved. Take a smaller detail size or step size.");
    report.stop = Stop::Grew;
    EXPECT_EQ(early_stop(),
              "Nothing has moved: step 1 would have made the surface larger, which no such flow "
              "does: some faces are needles, too narrow for their length. Remesh them, or take a "
              "smaller detail size or step size.");
    report.stop = Stop::NothingMoves;
    EXPECT_EQ(early_stop(),
              "Nothing has moved: all of the surface is held. Free the boundary, or select more; "
              "with the method Paper, take a greater depth.");
    report.stop = Stop::Pinched;
    report.steps.resize(3);
    EXPECT_EQ(early_stop(),
              "The flow stopped after step 3 of 10: so much has pinched that preserving would "
              "inflate what is left.");
}

TEST(Warnings, TellThatPartsAreDoubleSided) {
    FilterReport report;
    EXPECT_TRUE(surface_warnings(report).empty());
    report.double_sided_parts = 1;
    EXPECT_THAT(
        surface_warnings(report),
        testing::ElementsAre("A part of the surface is double-sided: most faces there have a copy "
                             "that looks the other way. A face and its copies count as one, and "
                             "move together."));
    report.double_sided_parts = 3;
    EXPECT_THAT(surface_warnings(report),
                testing::ElementsAre(HasSubstr("3 parts of the surface are double-sided")));
}

TEST(Warnings, TellThatAClosedMeshIsInsideOut) {
    const std::string warning =
        "The mesh is inside out: its faces point inwards. MeshLab's Invert Faces Orientation turns "
        "them.";
    const auto warnings = [](double volume) {
        FlowReport flow;
        NoiseReport noise;
        flow.area_before = noise.area_before = 10;
        flow.volume_before = noise.volume_before = volume;
        noise.vertices = noise.smoothing_steps = 1;
        const std::vector<std::string> of_flow = warnings_of(FlowParameters(), flow);
        EXPECT_EQ(warnings_of(NoiseParameters(), noise), of_flow);
        return of_flow;
    };
    EXPECT_EQ(warnings(-1), std::vector<std::string>{warning});
    for (const double volume : {1.0, kNoNumber, -1e-9}) EXPECT_TRUE(warnings(volume).empty());
}

TEST(Warnings, TellOfALimitedStepAFineDetailAndHandles) {
    FlowReport report;
    report.detail_size = report.cell_size = report.step_size = report.asked_step_size = 1;
    report.steps.resize(2);
    report.steps[0].area = 10;
    report.steps[1].area = report.area_after = 9.1;
    report.area_before = 10;
    report.longest_side = 1024;
    const auto warnings = [&] { return warnings_of({}, report); };
    EXPECT_TRUE(warnings().empty());
    report.asked_step_size = 4;
    ASSERT_EQ(warnings().size(), 1U);
    EXPECT_EQ(warnings()[0],
              "The step size is limited to 1 squared units of the mesh, instead of 4: waves longer "
              "than 1 keep more than half of their amplitude. More steps go further.");
    report.asked_step_size = 1;
    report.mean_edge = 2;
    ASSERT_EQ(warnings().size(), 1U);
    EXPECT_EQ(warnings()[0],
              "The detail size is 0.5 mean edges; below 2 little changes. The default is 3 edges, "
              "6.");
    report.mean_edge = 0.5;
    EXPECT_TRUE(warnings().empty());
    report.genus = 2;
    ASSERT_EQ(warnings().size(), 1U);
    EXPECT_EQ(warnings()[0],
              "The surface has 2 handles, so it cannot become a sphere. Close its tunnels first.");
    report.genus = 0;
}

TEST(Warnings, TellOfALargeLossOfArea) {
    FlowReport report;
    report.detail_size = report.step_size = report.asked_step_size = 1;
    report.mean_edge = 0.5;
    report.longest_side = 1024;
    report.area_before = 10;
    report.steps.resize(3);  // each removes less than 10 %
    report.area_after = 8;
    FlowParameters p;
    const auto warnings = [&] { return warnings_of(p, report); };
    EXPECT_THAT(warnings(),
                ElementsAre("The flow has removed 20 % of the area. If that is more than noise, "
                            "take a smaller detail size, or a greater order to keep the shape."));
    report.longest_side = 0.5;
    const std::string longer =
        "The flow has removed 20 % of the area: the detail size 1 is longer than the mesh. Take a "
        "smaller one, such as 2 % of the diagonal.";
    EXPECT_THAT(warnings(), ElementsAre(longer));
    report.boundary_edges = 3;
    EXPECT_THAT(warnings(), ElementsAre(longer));
    p.detail_size = 1;  // asks for a minimal surface
    EXPECT_THAT(warnings(), IsEmpty());
    report.boundary_edges = 0;
    p.preserve = Preserve::Volume;
    EXPECT_THAT(warnings(), IsEmpty());
    p.preserve = Preserve::None;
    report.area_after = 9.1;
    EXPECT_THAT(warnings(), IsEmpty());
    report.area_after = 0.01;
    report.stop = Stop::Vanished;
    EXPECT_EQ(warnings().size(), 1U) << "that it has";
}

}  // namespace

}  // namespace tracked_mcf
