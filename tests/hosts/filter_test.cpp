// The part of the plugin that no host is needed for: what it makes of the values that hosts pass.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/parameters/early_stop.h"
#include "filter_tracked_mcf/parameters/parameter_table.h"
#include "filter_tracked_mcf/plugin/parameter_values.h"
#include "filter_tracked_mcf/plugin/run_filter.h"

namespace tracked_mcf {

namespace {

ParameterValues values_other_than_default() {
    return {{"depth", 7},  {"step_size", 2e-4},       {"absolute", true}, {"iterations", 3},
            {"flow", 1},   {"boundary", 2},           {"selected", true}, {"rescale", 1},
            {"solver", 1}, {"separate_sheets", false}};
}

TEST(ParameterValues, EveryParameterOfTheTableIsRead) {
    for (const ParameterDescription& parameter : parameter_table()) {
        ParameterValues values = values_other_than_default();
        values.erase(parameter.name);
        const auto read = [&] {
            flow_parameters(values);
            selected_only(values);
        };
        EXPECT_THROW(read(), InvalidParameter) << parameter.name;
    }
}

TEST(ParameterValues, ReachTheCoreUnchanged) {
    const FlowParameters parameters = flow_parameters(values_other_than_default());
    EXPECT_EQ(parameters.depth, 7);
    EXPECT_EQ(parameters.step_size, 2e-4);
    EXPECT_TRUE(parameters.absolute);
    EXPECT_EQ(parameters.iterations, 3);
    EXPECT_EQ(parameters.flow, FlowKind::Conformalized);
    EXPECT_EQ(parameters.boundary, BoundaryCondition::Free);
    EXPECT_EQ(parameters.rescale, Rescaling::KeepArea);
    EXPECT_FALSE(parameters.separate_sheets);
    EXPECT_EQ(parameters.solver, Solver::OneWCycle);
}

TEST(ParameterValues, LabelsAreThoseOfTheCoresValues) {
    const std::map<std::string, std::pair<int, std::string>> labels = {
        {"flow", {static_cast<int>(FlowKind::Conformalized), "Conformalized"}},
        {"boundary", {static_cast<int>(BoundaryCondition::LockedCells), "Locked cells (paper)"}},
        {"rescale", {static_cast<int>(Rescaling::KeepVolume), "Keep volume"}},
        {"solver", {static_cast<int>(Solver::OneWCycle), "One W-cycle (paper)"}}};
    for (const ParameterDescription& parameter : parameter_table()) {
        const auto* const choice = std::get_if<ParameterDescription::Choice>(&parameter.type);
        if (choice == nullptr) continue;
        const auto& [index, label] = labels.at(parameter.name);
        EXPECT_EQ(choice->labels.at(static_cast<std::size_t>(index)), label);
        EXPECT_EQ(choice->default_value, 0) << parameter.name;
    }
}

TEST(ParameterValues, WhetherOnlyTheSelectionFlowsIsRead) {
    ParameterValues values = values_other_than_default();
    EXPECT_TRUE(selected_only(values));
    values["selected"] = false;
    EXPECT_FALSE(selected_only(values));
    values["selected"] = 1;
    EXPECT_THROW(selected_only(values), InvalidParameter);
}

TEST(ParameterValues, OneWCycleIsThePapersSystem) {
    ParameterValues values = values_other_than_default();
    EXPECT_EQ(stabilization_of(flow_parameters(values)), 0);
    EXPECT_EQ(flow_parameters(values).cycles, 1);
    values["solver"] = 0;
    EXPECT_EQ(stabilization_of(flow_parameters(values)), kDefaultStabilization);
}

TEST(ParameterValues, AChoiceWithoutALabelIsRefusedWithTheLabels) {
    for (const int index : {-1, 3, std::numeric_limits<int>::max()}) {
        ParameterValues values = values_other_than_default();
        values["boundary"] = index;
        try {
            flow_parameters(values);
            ADD_FAILURE() << index << " was accepted";
        } catch (const InvalidParameter& error) {
            EXPECT_EQ(error.what(), "boundary is " + std::to_string(index) +
                                        "; give 0 (Locked), 1 (Locked cells (paper)), 2 (Free).");
        }
    }
}

TEST(ParameterValues, AValueOfTheWrongTypeIsRefused) {
    const std::map<std::string, ParameterValue> wrong = {
        {"step_size", 1}, {"absolute", 0},  {"separate_sheets", 1}, {"solver", true},
        {"flow", false},  {"rescale", 0.0}, {"depth", 3.0}};
    for (const auto& [name, value] : wrong) {
        ParameterValues values = values_other_than_default();
        values[name] = value;
        EXPECT_THROW(flow_parameters(values), InvalidParameter) << name;
    }
}

TEST(AsTyped, RecoversTheDecimalOfAFloat) {
    EXPECT_EQ(as_typed(1e-5f), 1e-5);
    EXPECT_EQ(as_typed(0.1f), 0.1);
    EXPECT_EQ(as_typed(-2.5e-7f), -2.5e-7);
    EXPECT_EQ(as_typed(0.0f), 0.0);
    EXPECT_TRUE(std::isnan(as_typed(std::numeric_limits<float>::quiet_NaN())));
    EXPECT_EQ(as_typed(-std::numeric_limits<float>::infinity()),
              -std::numeric_limits<double>::infinity());
}

TEST(AsTyped, KeepsOtherDoubles) {
    for (const double value : {1e-5, 0.1, 1.0 / 3, 1e300, -1e-300}) {
        EXPECT_EQ(as_typed(value), value);
    }
    EXPECT_EQ(as_typed(0.25), 0.25);
}

TEST(Outputs, AreTheReportsNumbers) {
    using run_filter_detail::outputs_of;
    FlowReport report;
    report.unknowns = 1234;
    report.depth = 7;
    report.area_before = 2.5;
    report.area_after = 2.25;
    report.steps.resize(3);
    report.steps[1].relative_residual = 0.5;
    report.steps[2].relative_residual = 0.125;
    report.steps[2].residual_before = 8;
    report.steps[2].residual_after = 2;
    FlowParameters parameters;
    EXPECT_EQ(outputs_of(parameters, report), (Outputs{{"unknowns", 1234},
                                                       {"depth", 7},
                                                       {"steps", 3},
                                                       {"final_residual", 0.125},
                                                       {"area_before", 2.5},
                                                       {"area_after", 2.25}}));
    parameters.solver = Solver::OneWCycle;
    EXPECT_EQ(outputs_of(parameters, report).at("final_residual"), Outputs::mapped_type(0.25));
    report.steps.clear();
    EXPECT_EQ(outputs_of(parameters, report).at("final_residual"), Outputs::mapped_type(0.0));
}

TEST(Summary, SaysWhichStepStoppedShortOfTheToleranceAndWhatToDo) {
    using run_filter_detail::summary;
    FlowReport report;
    report.steps.resize(5);
    EXPECT_EQ(summary({}, report).find("Warning"), std::string::npos);
    report.steps[3].reached_tolerance = false;
    report.steps[3].relative_residual = 0.02;
    report.steps[3].solver_iterations = 100;
    const std::string text = summary({}, report);
    EXPECT_NE(text.find(" Warning: The solver stopped short of the tolerance 0.001 in 1 of 5 "
                        "steps: step 4, at 0.02 after 100 iterations. Look at the result; "),
              std::string::npos)
        << text;
}

TEST(Summary, TellsTheFlowAndWhatIsHeld) {
    using run_filter_detail::summary;
    FlowParameters parameters;
    FlowReport report;
    report.vertices = 100;
    report.steps.resize(10);
    EXPECT_EQ(summary(parameters, report).find("Smoothed 100 vertices by 10 steps of mean-curv"),
              0u);
    parameters.flow = FlowKind::Conformalized;
    report.held_vertices = 12;
    EXPECT_EQ(summary(parameters, report)
                  .find("Smoothed 100 vertices, of which 12 are held, by 10 steps of conformalized "
                        "mean-curvature flow: "),
              0u);
}

TEST(Summary, SaysWhereTheFlowStoppedAndWhy) {
    FlowReport report;
    report.steps.resize(3);
    report.stop = Stop::Vanished;
    const std::string text = run_filter_detail::summary({}, report);
    EXPECT_NE(text.find("by 3 steps"), std::string::npos) << text;
    EXPECT_NE(text.find(" Warning: The flow stopped after step 3 of 10: step 4 would have left no "
                        "surface."),
              std::string::npos)
        << text;
}

TEST(EarlyStop, SaysWhenWhyAndWhatToDo) {
    FlowReport report;
    EXPECT_EQ(early_stop(report, 10), "");
    report.stop = Stop::Vanished;
    EXPECT_EQ(early_stop(report, 10),
              "Nothing has moved: the first step would have left no surface. Take a smaller step "
              "size.");
    report.stop = Stop::NothingMoves;
    EXPECT_EQ(early_stop(report, 10),
              "Nothing has moved: all of the surface is held. Free the boundary, or select more; "
              "where cells are locked, take a greater depth.");
    report.stop = Stop::Pinched;
    report.steps.resize(3);
    EXPECT_EQ(early_stop(report, 10),
              "The flow stopped after step 3 of 10: so much has pinched that rescaling would blow "
              "up what is left.");
    report.stop = Stop::NothingMoves;
    report.steps.resize(1);
    EXPECT_EQ(early_stop(report, 10),
              "The flow stopped after step 1 of 10: everything that could move has pinched.");
}

TEST(Guard, TurnsEveryExceptionIntoAMessage) {
    const FilterOutcome done = guard([] { return FilterOutcome{true, "done", {{"depth", 5}}}; });
    EXPECT_TRUE(done.succeeded);
    EXPECT_EQ(done.message, "done");
    EXPECT_EQ(done.outputs.size(), 1u);
    const auto message_of = [](auto thrown) {
        const FilterOutcome outcome = guard([&]() -> FilterOutcome { throw thrown; });
        EXPECT_FALSE(outcome.succeeded);
        return outcome.message;
    };
    EXPECT_EQ(message_of(InvalidMesh("No faces.")), "No faces.");
    EXPECT_NE(message_of(std::bad_alloc()).find("memory"), std::string::npos);
    EXPECT_FALSE(message_of(42).empty());
}

TEST(Progress, CountsInPercentAndPassesOnTheWishToStop) {
    EXPECT_FALSE(run_filter_detail::as_progress(nullptr));
    const Progress progress = run_filter_detail::as_progress(
        +[](int percent, const char* phase) { return percent == 50 && phase == std::string("x"); });
    EXPECT_TRUE(progress(0.5, std::string_view("xyz").substr(0, 1)));
    EXPECT_FALSE(progress(1.0, "x"));
}

}  // namespace

}  // namespace tracked_mcf
