// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/tool/report_json.h"

#include <algorithm>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>
#include <variant>

#include "filter_tracked_mcf/parameters/fair_warnings.h"
#include "filter_tracked_mcf/parameters/flow_warnings.h"
#include "filter_tracked_mcf/parameters/noise_warnings.h"
#include "filter_tracked_mcf/parameters/report_values.h"

namespace tracked_mcf {

namespace {

using Json = nlohmann::ordered_json;

Json as_json(const ReportValue& value);

Json as_json(std::monostate) {
    return {};
}

template <class Scalar>
Json as_json(const Scalar& scalar) {
    return scalar;
}

Json as_json(const ReportList& list) {
    Json json = Json::array();
    for (const ReportValue& value : list) json.push_back(as_json(value));
    return json;
}

Json as_json(const ReportObject& object) {
    Json json = Json::object();
    for (const auto& [name, value] : object) json[name] = as_json(value);
    return json;
}

Json as_json(const ReportValue& value) {
    return std::visit([](const auto& held) { return as_json(held); }, value.value);
}

/// Says how the steps were solved, such as "4 to 6 iterations of conjugate gradients".
std::string effort(const FlowParameters& parameters, const std::vector<StepReport>& steps) {
    const auto [least, most] = std::minmax_element(
        steps.begin(), steps.end(),
        [](const auto& a, const auto& b) { return a.solver_iterations < b.solver_iterations; });
    const bool cycles = parameters.solver == Solver::OneWCycle;
    std::ostringstream text;
    text << least->solver_iterations;
    if (most->solver_iterations > least->solver_iterations)
        text << " to " << most->solver_iterations;
    text << (cycles ? " W-cycle" : " iteration") << (most->solver_iterations == 1 ? "" : "s");
    if (!cycles) text << " of conjugate gradients";
    return text.str();
}

double total_seconds(const FlowReport& report) {
    double seconds = report.setup_seconds;
    for (const StepReport& step : report.steps)
        seconds += step.assemble_seconds + step.solve_seconds;
    return seconds;
}

template <class Report>
std::string counts(const CommandLine& line, const Report& report) {
    std::ostringstream text;
    text << line.input.u8string() << ": " << report.vertices << " vertices, " << report.triangles
         << " triangles";
    if (report.degenerate_triangles > 0) {
        text << ", of which " << report.degenerate_triangles << " have zero area and were ignored";
    }
    return text.str();
}

template <class Report>
std::string constrained(const Report& report) {
    if (report.constrained_vertices == 0) return {};
    return "\n" + std::to_string(report.constrained_vertices) +
           " vertices are constrained: they keep their positions";
}

template <class Parameters, class Report>
std::string json_of(const CommandLineOf<Parameters>& line, const Report& report,
                    const std::vector<std::string>& warnings) {
    ReportValue selected, strength;
    if (!line.selected.empty()) selected.value = line.selected;
    if (!line.strength.empty()) strength.value = line.strength;
    Json json = {{"program", "tracked_mcf"},
                 {"version", TRACKED_MCF_VERSION},
                 {"input", line.input.u8string()},
                 {"output", line.output.u8string()}};
    json.update(as_json(report_values(line.parameters, selected, strength, report, warnings)));
    // JSON must be UTF-8; file names need not be.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace

std::string report_json(const CommandLineOf<FlowParameters>& line, const FlowReport& report,
                        const std::vector<std::string>& warnings) {
    return json_of(line, report, warnings);
}

std::string report_json(const CommandLineOf<NoiseParameters>& line, const NoiseReport& report,
                        const std::vector<std::string>& warnings) {
    return json_of(line, report, warnings);
}

std::string report_json(const CommandLineOf<FairParameters>& line, const FairReport& report,
                        const std::vector<std::string>& warnings) {
    return json_of(line, report, warnings);
}

std::string summary(const CommandLineOf<FlowParameters>& line, const FlowReport& report) {
    std::ostringstream text;
    text << counts(line, report) << "\ndepth " << report.depth << ": " << report.cells << " cells, "
         << report.unknowns << " unknowns";
    if (report.constrained_unknowns > 0)
        text << ", of which " << report.constrained_unknowns << " are constrained";
    text << constrained(report);
    if (!report.steps.empty())
        text << "\nsolved by " << effort(line.parameters, report.steps) << " in each step";
    text << "\n"
         << changes(report) << "\n"
         << report.steps.size() << (report.steps.size() == 1 ? " step in " : " steps in ")
         << std::fixed << std::setprecision(1) << total_seconds(report)
         << " s: " << line.output.u8string() << "\n";
    return text.str();
}

std::string summary(const CommandLineOf<NoiseParameters>& line, const NoiseReport& report) {
    std::ostringstream text;
    text << counts(line, report) << constrained(report) << "\n"
         << changes(report) << "\n"
         << report.steps << (report.steps == 1 ? " step" : " steps");
    if (report.sharpenings > 0) text << ", then creases sharpened,";
    text << " in " << std::fixed << std::setprecision(1) << report.seconds
         << " s: " << line.output.u8string() << "\n";
    return text.str();
}

std::string summary(const CommandLineOf<FairParameters>& line, const FairReport& report) {
    std::ostringstream text;
    text << line.input.u8string() << ": " << report.vertices << " vertices move, in "
         << report.patches << (report.patches == 1 ? " patch" : " patches") << "\n"
         << changes(report) << "\n"
         << report.iterations << (report.iterations == 1 ? " iteration in " : " iterations in ")
         << std::fixed << std::setprecision(1) << report.seconds << " s: " << line.output.u8string()
         << "\n";
    return text.str();
}

std::vector<std::string> warnings(const CommandLineOf<FlowParameters>& line,
                                  const FlowReport& report) {
    const char* const advice = stabilization_of(line.parameters) < kDefaultStabilization
                                   ? "Give a larger --stabilization or --tolerance."
                                   : "Give a larger --tolerance or a smaller --detail-size.";
    return warnings_of(line.parameters, report, advice);
}

std::vector<std::string> warnings(const CommandLineOf<NoiseParameters>& line,
                                  const NoiseReport& report) {
    return warnings_of(line.parameters, report, "");
}

std::vector<std::string> warnings(const CommandLineOf<FairParameters>& line,
                                  const FairReport& report) {
    return warnings_of(line.parameters, report, "");
}

}  // namespace tracked_mcf
