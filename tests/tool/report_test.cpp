#include "filter_tracked_mcf/tool/report_json.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "tests/tool/temporary_folder.h"

namespace tracked_mcf {
namespace {

using Json = nlohmann::json;

TEST(Report, HoldsEveryMemberUnderItsName) {
    CommandLine line;
    line.input = "in.ply";
    line.output = "out.obj";
    line.parameters = {7, 2e-4, 3, BoundaryCondition::Free, Cubature::Degree6, 2, 1};
    FlowReport report;
    report.vertices = 1;
    report.triangles = 2;
    report.degenerate_triangles = 3;
    report.boundary_edges = 4;
    report.depth = 5;
    report.cell_size = 6.5;
    report.cells = 7;
    report.unknowns = 8;
    report.locked_unknowns = 9;
    report.fragments = 10;
    report.split_triangles = 11;
    report.samples = 12;
    report.setup_seconds = 13.5;
    report.steps = {{0.5, 0.25, 1e-3, 1e-6, 12.5, 1}, {0.75, 0.125, 1e-4, 1e-7, 11.5, 2}};
    report.peak_memory_bytes = std::int64_t{1} << 40;
    const Json expected = Json::parse(R"({
        "program": "tracked_mcf", "version": ")" TRACKED_MCF_VERSION R"(",
        "input": "in.ply", "output": "out.obj",
        "parameters": {"depth": 7, "step_size": 2e-4, "iterations": 3, "boundary": "free",
                       "cubature": 11, "cycles": 2, "threads": 1},
        "vertices": 1, "triangles": 2, "degenerate_triangles": 3, "boundary_edges": 4,
        "depth": 5, "cell_size": 6.5, "cells": 7, "unknowns": 8, "locked_unknowns": 9,
        "fragments": 10, "split_triangles": 11, "samples": 12, "setup_seconds": 13.5,
        "steps": [{"assemble_seconds": 0.5, "solve_seconds": 0.25, "residual_before": 1e-3,
                   "residual_after": 1e-6, "area": 12.5, "collapsed_samples": 1},
                  {"assemble_seconds": 0.75, "solve_seconds": 0.125, "residual_before": 1e-4,
                   "residual_after": 1e-7, "area": 11.5, "collapsed_samples": 2}],
        "peak_memory_bytes": 1099511627776})");
    EXPECT_EQ(Json::parse(report_json(line, report)), expected);
}

TEST(Report, IsJsonWhateverTheFileNames) {
    CommandLine line;
    line.input = "\xff\"\n.ply";
    EXPECT_TRUE(Json::accept(report_json(line, {})));
}

TEST(Report, OfARunIsConsistent) {
    const TemporaryFolder folder;
    write_file(folder / "a.off",
               "OFF\n5 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n7 7 7\n"
               "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
    const ProgramRun run =
        run_program(folder, "a.off b.ply --depth 4 --iterations 3 --report r.json --cubature 1");
    ASSERT_EQ(run.exit_code, 0) << run.errors;
    const Json report = Json::parse(read_file(folder / "r.json"));
    EXPECT_EQ(report["vertices"], 4) << "the last one has no face";
    EXPECT_EQ(report["triangles"], 4);
    EXPECT_EQ(report["boundary_edges"], 0);
    EXPECT_EQ(report["locked_unknowns"], 0);
    EXPECT_EQ(report["depth"], 4);
    EXPECT_EQ(report["samples"], report["split_triangles"]) << "one sample each";
    EXPECT_GE(report["split_triangles"], report["fragments"]);
    EXPECT_GE(report["unknowns"], report["cells"]);
    EXPECT_GT(report["peak_memory_bytes"], 1000000);
    ASSERT_EQ(report["steps"].size(), 3u);
    EXPECT_NEAR(report["steps"][0]["area"], 1.5 + std::sqrt(3) / 2, 1e-6) << "summed in floats";
    for (const Json& step : report["steps"]) {
        EXPECT_LT(step["residual_after"], step["residual_before"]);
    }
}

}  // namespace
}  // namespace tracked_mcf
