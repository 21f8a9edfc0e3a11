// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/tool/report_json.h"

#include <algorithm>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>
#include <variant>

#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/parameters/flow_warnings.h"

namespace tracked_mcf {

namespace {

using Json = nlohmann::ordered_json;

/// Returns the value of a parameter: of a choice its name, or its number if that is its name.
Json value_json(const Parameter& parameter, const CommandLine& line) {
    const ParameterValue value = parameter.get(line.parameters);
    if (parameter.type == Parameter::Type::Selected) {
        return line.selected.empty() ? Json() : Json(line.selected);
    }
    if (parameter.type == Parameter::Type::Choice) {
        const std::string& name = parameter.choices.at(std::get<int>(value)).name;
        return Json::accept(name) ? Json::parse(name) : Json(name);
    }
    return std::visit([](auto number) { return Json(number); }, value);
}

Json parameters_json(const CommandLine& line) {
    Json json;
    for (const Parameter& parameter : parameter_table()) {
        json[parameter.name] = value_json(parameter, line);
    }
    return json;
}

const char* stop_name(Stop stop) {
    if (stop == Stop::Vanished) return "vanished";
    if (stop == Stop::Pinched) return "pinched";
    if (stop == Stop::StepFailed) return "step failed";
    if (stop == Stop::NotPreserved) return "volume not preserved";
    return stop == Stop::NothingMoves ? "nothing moves" : "none";
}

Json step_json(const StepReport& step, Solver solver) {
    const bool knows_tolerance = solver == Solver::Converged;
    return {{"assemble_seconds", step.assemble_seconds},
            {"solve_seconds", step.solve_seconds},
            {"residual_before", step.residual_before},
            {"residual_after", step.residual_after},
            {"solver_iterations", step.solver_iterations},
            {"error_estimate", knows_tolerance ? Json(step.error_estimate) : Json()},
            {"reached_tolerance", knows_tolerance ? Json(step.reached_tolerance) : Json()},
            {"area", step.area},
            {"collapsed_samples", step.collapsed_samples}};
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

}  // namespace

std::string report_json(const CommandLine& line, const FlowReport& report,
                        const std::vector<std::string>& warnings) {
    Json steps = Json::array();
    for (const StepReport& step : report.steps) {
        steps.push_back(step_json(step, line.parameters.solver));
    }
    const Json json = {
        {"program", "tracked_mcf"},
        {"version", TRACKED_MCF_VERSION},
        {"input", line.input.u8string()},
        {"output", line.output.u8string()},
        {"parameters", parameters_json(line)},
        {"vertices", report.vertices},
        {"triangles", report.triangles},
        {"degenerate_triangles", report.degenerate_triangles},
        {"boundary_edges", report.boundary_edges},
        {"constrained_vertices", report.constrained_vertices},
        {"detail_size", report.detail_size},
        {"step_size", report.step_size},
        {"normal_length", report.normal_length},
        {"edge_share", report.edge_share},
        {"noise", report.noise},
        {"depth", report.depth},
        {"cell_size", report.cell_size},
        {"cells", report.cells},
        {"elements", report.elements},
        {"unknowns", report.unknowns},
        {"constrained_unknowns", report.constrained_unknowns},
        {"fragments", report.fragments},
        {"split_triangles", report.split_triangles},
        {"samples", report.samples},
        {"area_before", report.area_before},
        {"area_after", report.area_after},
        {"volume_change", report.oriented_consistently ? Json(report.volume_change) : Json()},
        {"largest_displacement", report.largest_displacement},
        {"rms_displacement", report.rms_displacement},
        {"setup_seconds", report.setup_seconds},
        {"steps", steps},
        {"converged", converged(report)},
        {"stop", stop_name(report.stop)},
        {"warnings", warnings},
        {"estimated_memory_bytes", report.estimated_memory_bytes},
        {"peak_memory_bytes", report.peak_memory_bytes}};
    // JSON must be UTF-8; file names need not be.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string summary(const CommandLine& line, const FlowReport& report) {
    std::ostringstream text;
    text << line.input.u8string() << ": " << report.vertices << " vertices, " << report.triangles
         << " triangles";
    if (report.degenerate_triangles > 0) {
        text << ", of which " << report.degenerate_triangles << " have zero area and were ignored";
    }
    text << "\ndepth " << report.depth << ": " << report.cells << " cells, " << report.unknowns
         << " unknowns";
    if (report.constrained_unknowns > 0)
        text << ", of which " << report.constrained_unknowns << " are constrained";
    if (report.constrained_vertices > 0)
        text << "\n"
             << report.constrained_vertices
             << " vertices are constrained: they keep their positions";
    if (!report.steps.empty())
        text << "\nsolved by " << effort(line.parameters, report.steps) << " in each step";
    text << "\n"
         << changes(report) << "\n"
         << report.steps.size() << (report.steps.size() == 1 ? " step in " : " steps in ")
         << std::fixed << std::setprecision(1) << total_seconds(report)
         << " s: " << line.output.u8string() << "\n";
    return text.str();
}

std::vector<std::string> warnings(const CommandLine& line, const FlowReport& report) {
    const char* const advice = stabilization_of(line.parameters) < kDefaultStabilization
                                   ? "Give a larger --stabilization or --tolerance."
                                   : "Give a larger --tolerance or a smaller --detail-size.";
    return flow_warnings(line.parameters, report, advice);
}

}  // namespace tracked_mcf
