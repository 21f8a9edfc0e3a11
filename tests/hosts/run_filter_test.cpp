// SPDX-License-Identifier: GPL-3.0-or-later
// Tests the code of the plugin that needs no host: it converts the values that hosts pass.

#include <gtest/gtest.h>

#include <cmath>
#include <exception>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/hosts/meshlab/run_filter.h"
#include "filter_tracked_mcf/presentation/report_table.h"

namespace tracked_mcf {

namespace {

/// Returns the message of a filter that fails with this error.
template <class Error>
std::string message_of(const Error& error) {
    const FilterOutcome outcome =
        guard([&]() -> FilterOutcome { std::rethrow_exception(std::make_exception_ptr(error)); });
    EXPECT_FALSE(outcome.succeeded);
    return outcome.message;
}

TEST(Guard, AMessageAboutAParameterSaysItsLabel) {
    EXPECT_EQ(message_of(InvalidParameter("depth", "is 13; give 0 to 12.", 13)),
              "depth is 13; give 0 to 12. In the dialog it is \"Octree depth (expert)\".");
    EXPECT_EQ(message_of(InvalidParameter("threads", "is -1; give more.", -1)),
              "threads is -1; give more.");
    EXPECT_EQ(message_of(InvalidMesh("depth is no word of this.")), "depth is no word of this.");
}

TEST(Guard, AZeroMayBeANumberThatMeshLabCouldNotRead) {
    EXPECT_EQ(message_of(InvalidParameter("iterations", "is 0; give 1 to 9.", 0)),
              "iterations is 0; give 1 to 9. In the dialog it is \"Smoothing steps\". MeshLab "
              "reads a number with a decimal comma as 0: use a point.");
}

TEST(Outputs, AreAllNumbersOfTheReport) {
    using run_filter_detail::outputs_of;
    FlowReport report;
    report.detail_size = 0.5;
    report.unknowns = 1234;
    report.volume_change = -1.5;
    report.steps.resize(3);
    report.peak_memory_bytes = std::int64_t{1} << 40;
    const Outputs outputs = outputs_of(report);
    EXPECT_EQ(outputs.at("detail_size"), Outputs::mapped_type(0.5));
    EXPECT_EQ(outputs.at("unknowns"), Outputs::mapped_type(1234));
    EXPECT_EQ(outputs.at("iterations"), Outputs::mapped_type(3));
    EXPECT_EQ(outputs.at("stopped_early"), Outputs::mapped_type(0));
    EXPECT_EQ(outputs.at("converged"), Outputs::mapped_type(1));
    EXPECT_EQ(outputs.at("volume_change"), Outputs::mapped_type(-1.5));
    EXPECT_TRUE(std::isnan(std::get<double>(outputs.at("volume_before"))));
    EXPECT_EQ(outputs.at("peak_memory_bytes"), Outputs::mapped_type(std::pow(2.0, 40)));
    EXPECT_EQ(outputs.count("stop") + outputs.count("steps"), 0U) << "they are no numbers";
    EXPECT_EQ(outputs.size(), report_table<FlowReport>().size() - 2);
}

TEST(Guard, TurnsEveryExceptionIntoAMessage) {
    const auto work = [] { return FilterOutcome{true, "done", {{"depth", 5}}}; };
    const FilterOutcome done = guard(work);
    EXPECT_TRUE(done.succeeded);
    EXPECT_EQ(done.message, "done");
    EXPECT_EQ(done.outputs.size(), 1u);
    EXPECT_EQ(message_of(InvalidMesh("No faces.")), "No faces.");
    EXPECT_NE(message_of(std::bad_alloc()).find("memory"), std::string::npos);
    EXPECT_FALSE(message_of(42).empty());
}

TEST(Progress, IsInPercentAndStopsWhenTheHostAsks) {
    EXPECT_FALSE(as_progress(nullptr));
    const Progress progress = as_progress(
        +[](int percent, const char* phase) { return percent == 50 && phase == std::string("x"); });
    EXPECT_TRUE(progress(0.5, std::string_view("xyz").substr(0, 1)));
    EXPECT_FALSE(progress(1.0, "x"));
}

}  // namespace

}  // namespace tracked_mcf
