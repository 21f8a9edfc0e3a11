// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/report_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "filter_tracked_mcf/presentation/flow_warnings.h"
#include "filter_tracked_mcf/presentation/summary.h"
#include "tests/cli/temporary_folder.h"

namespace tracked_mcf {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;

TEST(Report, HoldsEveryMemberUnderItsName) {
    CommandLineOf<FlowParameters> line;
    line.input = "in.ply";
    line.output = "out.obj";
    line.parameters.detail_size = 0.375;
    line.parameters.order = 2;
    line.parameters.depth = 7;
    line.parameters.step_size = 2e-4;
    line.parameters.iterations = 3;
    line.parameters.flow = FlowKind::Conformalized;
    line.parameters.boundary = BoundaryCondition::Free;
    line.properties = {{"selected", "q"}, {"strength", "s"}};
    line.parameters.preserve = Preserve::Area;
    line.parameters.quality = Quality::Displacement;
    line.parameters.method = Method::Converged;
    line.parameters.tolerance = 0.5;
    line.parameters.threads = 1;
    FlowReport report;
    report.vertices = 1;
    report.triangles = 2;
    report.degenerate_triangles = 3;
    report.copied_triangles = 18;
    report.double_sided_parts = 19;
    report.boundary_edges = 4;
    report.cracks = {16, 17, 0.5};
    report.held_vertices = 15;
    report.detail_size = 0.4375;
    report.step_size = 0.0625;
    report.depth = 5;
    report.cell_size = 6.5;
    report.cells = 7;
    report.elements = 14;
    report.unknowns = 8;
    report.constrained_unknowns = 9;
    report.fragments = 10;
    report.split_triangles = 11;
    report.samples = 12;
    report.area_before = 20.5;
    report.area_after = 19.5;
    report.volume_change = -2.5;
    report.volume_before = 10.5;
    report.largest_displacement = 0.75;
    report.rms_displacement = 0.25;
    report.setup_seconds = 13.5;
    report.seconds = 14.5;
    report.steps = {{0.5, 0.25, 1e-3, 1e-6, 6, 0.125, true, 12.5, 1},
                    {0.75, 0.125, 1e-4, 1e-7, 100, 0.75, false, 11.5, 2}};
    report.stop = Stop::Vanished;
    report.estimated_memory_bytes = std::int64_t{1} << 39;
    report.peak_memory_bytes = std::int64_t{1} << 40;
    const Json expected = Json::parse(R"({
        "program": "tracked_mcf", "version": ")" TRACKED_MCF_VERSION R"(",
        "input": "in.ply", "output": "out.obj",
        "parameters": {"detail_size": 0.375, "order": 2, "depth": 7,
                       "step_size": 2e-4, "iterations": 3,
                       "flow": "conformalized", "boundary": "free", "selected": "q", "strength": "s",
                       "preserve": "area", "quality": "displacement",
                       "method": "converged", "tolerance": 0.5, "threads": 1},
        "vertices": 1, "triangles": 2, "degenerate_triangles": 3, "boundary_edges": 4,
        "copied_triangles": 18, "double_sided_parts": 19,
        "joined_vertices": 16, "open_pairs": 17,
        "held_vertices": 15, "detail_size": 0.4375, "step_size": 0.0625,
        "area_before": 20.5, "area_after": 19.5,
        "volume_before": 10.5, "volume_after": 8, "volume_change": -2.5,
        "largest_displacement": 0.75, "rms_displacement": 0.25, "converged": false, "stop": "vanished",
        "stopped_early": true, "iterations": 2, "error_estimate": 0.75, "seconds": 14.5,
        "warnings": ["first", "second"],
        "depth": 5, "cell_size": 6.5, "cells": 7, "elements": 14, "unknowns": 8, "constrained_unknowns": 9,
        "fragments": 10, "split_triangles": 11, "samples": 12, "setup_seconds": 13.5,
        "steps": [{"assemble_seconds": 0.5, "solve_seconds": 0.25, "residual_before": 1e-3,
                   "residual_after": 1e-6, "solver_iterations": 6, "error_estimate": 0.125,
                   "reached_tolerance": true, "area": 12.5, "collapsed_samples": 1},
                  {"assemble_seconds": 0.75, "solve_seconds": 0.125, "residual_before": 1e-4,
                   "residual_after": 1e-7, "solver_iterations": 100, "error_estimate": 0.75,
                   "reached_tolerance": false, "area": 11.5, "collapsed_samples": 2}],
        "estimated_memory_bytes": 549755813888, "peak_memory_bytes": 1099511627776})");
    EXPECT_EQ(Json::parse(report_json(line, report, {"first", "second"})), expected);
}

TEST(Report, WCyclesKnowNoTolerance) {
    CommandLineOf<FlowParameters> line;
    line.parameters.method = Method::Paper;
    FlowReport report;
    report.steps.resize(1);
    report.steps[0].solver_iterations = 2;
    report.steps[0].error_estimate = kNoNumber;
    report.steps[0].residual_before = 8;
    report.steps[0].residual_after = 2;
    const Json json = Json::parse(report_json(line, report, {}));
    EXPECT_EQ(json["parameters"]["method"], "paper");
    const Json step = json["steps"][0];
    EXPECT_EQ(step["solver_iterations"], 2);
    EXPECT_TRUE(step["error_estimate"].is_null());
    EXPECT_EQ(json["error_estimate"], 0.25) << "of the residual";
}

TEST(Report, HasAVolumeOnlyOfConsistentlyOrientedFaces) {
    FlowReport report;
    report.volume_change = 0.5;
    EXPECT_EQ(Json::parse(report_json({}, report, {}))["volume_change"], 0.5);
    EXPECT_TRUE(Json::parse(report_json({}, report, {}))["volume_before"].is_null());
    report.volume_change = kNoNumber;
    EXPECT_TRUE(Json::parse(report_json({}, report, {}))["volume_change"].is_null());
}

TEST(Report, SaysWhetherAllStepsConverged) {
    FlowReport report;
    const auto converged = [&] { return Json::parse(report_json({}, report, {}))["converged"]; };
    EXPECT_EQ(converged(), true);
    report.steps.resize(2);
    EXPECT_EQ(converged(), true);
    report.steps[1].reached_tolerance = false;
    EXPECT_EQ(converged(), false);
}

TEST(Details, TellTheGridAndTheSolversIterations) {
    FlowParameters parameters;
    FlowReport report;
    report.depth = 7;
    report.cell_size = 0.25;
    report.cells = 10;
    report.unknowns = 30;
    const std::string grid =
        "Grid of depth 7: cells 0.25 wide, 10 of them occupied, 30 unknowns.\n";
    EXPECT_EQ(solver_details(parameters, report), grid);
    report.step_size = 0.0156;
    report.steps.resize(3);
    report.steps[0].solver_iterations = 5;
    report.steps[1].solver_iterations = 4;
    report.steps[2].solver_iterations = 11;
    EXPECT_EQ(solver_details(parameters, report),
              grid +
                  "Step size 0.0156, in squared units of the mesh, solved by 4 to 11 iterations "
                  "of conjugate gradients in each step.\n");
    parameters.method = Method::Paper;
    report.steps.resize(1);
    EXPECT_THAT(solver_details(parameters, report), HasSubstr("solved by 5 W-cycles of"));
    report.steps[0].solver_iterations = 1;
    EXPECT_THAT(solver_details(parameters, report), HasSubstr("solved by 1 W-cycle of"));
}

TEST(Report, NamesEveryWayToStop) {
    FlowReport report;
    for (const auto& [stop, name] : {std::pair{Stop::None, "none"},
                                     {Stop::Vanished, "vanished"},
                                     {Stop::Pinched, "pinched"},
                                     {Stop::NotPreserved, "volume not preserved"},
                                     {Stop::StepFailed, "step failed"},
                                     {Stop::Grew, "area grew"},
                                     {Stop::NothingMoves, "nothing moves"}}) {
        report.stop = stop;
        EXPECT_EQ(Json::parse(report_json({}, report, {}))["stop"], name);
    }
}

TEST(Report, SelectedIsNullUnlessGiven) {
    EXPECT_TRUE(Json::parse(report_json({}, FlowReport(), {}))["parameters"]["selected"].is_null());
    EXPECT_TRUE(Json::parse(report_json({}, FlowReport(), {}))["parameters"]["strength"].is_null());
}

TEST(Warnings, NameTheWorstStepThatStoppedShort) {
    FlowReport report;
    report.steps.resize(4);
    EXPECT_TRUE(warnings_of(FlowParameters(), report).empty());
    report.steps[2].error_estimate = 0.0321;
    report.steps[2].solver_iterations = 100;
    report.steps[2].reached_tolerance = false;
    EXPECT_EQ(
        warnings_of(FlowParameters(), report),
        std::vector<std::string>{
            "The solver stopped short of the tolerance 0.001 in 1 of 4 steps: step 3, at "
            "0.032 after 100 iterations. Look at the result; a smaller detail size may help."});
    report.steps[1] = report.steps[2];
    report.steps[1].error_estimate = 0.5;
    EXPECT_EQ(warnings_of(FlowParameters(), report),
              std::vector<std::string>{
                  "The solver stopped short of the tolerance 0.001 in 2 of 4 steps: the worst is "
                  "step 2, at 0.5 after 100 iterations. Look at the result; a smaller detail size "
                  "may help."});
}

TEST(Report, HoldsEveryWarningThatIsPrinted) {
    const TemporaryFolder folder;
    write_file(folder / "a.obj",
               "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\n"
               "f 1/1 3/1 2/1\nf 1/1 2/1 4/1\nf 1/1 4/1 3/1\nf 2/1 3/1 4/1\n");
    const ProgramRun run = run_program(folder, "a.obj b.ply --detail-size 50% --report r.json");
    ASSERT_EQ(run.exit_code, 0) << run.errors;
    const Json warnings = Json::parse(read_file(folder / "r.json"))["warnings"];
    ASSERT_EQ(warnings.size(), 2u) << run.errors;
    std::string lines;
    for (const Json& warning : warnings) {
        lines += "tracked_mcf: warning: " + warning.get<std::string>() + "\n";
    }
    EXPECT_EQ(run.errors, lines);
}

TEST(Report, IsJsonWhateverTheFileNames) {
    CommandLineOf<FlowParameters> line;
    line.input = "\xff\"\n.ply";
    EXPECT_TRUE(Json::accept(report_json(line, {}, {})));
}

TEST(Report, TheMemoryExpectedCountsTheFile) {
    if (TRACKED_MCF_SANITIZED) GTEST_SKIP() << "sanitizers take memory of their own";
    const TemporaryFolder folder;
    // A torus.
    constexpr int n = 300;
    std::ostringstream obj;
    for (int i = 0; i < n * n; ++i) {
        const int column = i % n, row = i / n;
        const double u = 2 * M_PI / n * column, v = 2 * M_PI / n * row;
        obj << "v " << (2 + std::cos(u)) * std::cos(v) << ' ' << (2 + std::cos(u)) * std::sin(v)
            << ' ' << std::sin(u) << "\n# a comment, which the program keeps until it writes\n";
    }
    for (int i = 0; i < n * n; ++i) {
        const int right = i / n * n + (i + 1) % n, up = (i + n) % (n * n);
        obj << "f " << i + 1 << ' ' << right + 1 << ' ' << (right + n) % (n * n) + 1 << ' '
            << up + 1 << '\n';
    }
    write_file(folder / "a.obj", obj.str());
    const ProgramRun run = run_program(folder, "a.obj b.obj --depth 4 --report r.json");
    ASSERT_EQ(run.exit_code, 0) << run.errors;
    const Json report = Json::parse(read_file(folder / "r.json"));
    EXPECT_EQ(report["triangles"], 2 * n * n);
    const double estimate = report["estimated_memory_bytes"], peak = report["peak_memory_bytes"];
    EXPECT_GT(estimate, 0.7 * peak);
    EXPECT_LT(estimate, 1.4 * peak);
}

}  // namespace
}  // namespace tracked_mcf
