#include "filter_tracked_mcf/tool/report_json.h"

#include <algorithm>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

#include "filter_tracked_mcf/parameters/early_stop.h"
#include "filter_tracked_mcf/parameters/shortfall.h"

namespace tracked_mcf {

namespace {

using Json = nlohmann::ordered_json;

Json parameters_json(const CommandLine& line) {
    const FlowParameters& parameters = line.parameters;
    return {{"depth", parameters.depth},
            {"step_size", parameters.step_size},
            {"absolute", parameters.absolute},
            {"iterations", parameters.iterations},
            {"flow", flow_name(parameters.flow)},
            {"boundary", boundary_name(parameters.boundary)},
            {"selected", line.selected.empty() ? Json() : Json(line.selected)},
            {"rescale", rescaling_name(parameters.rescale)},
            {"separate_sheets", parameters.separate_sheets},
            {"cubature", cubature_name(parameters.cubature)},
            {"solver", solver_name(parameters.solver)},
            {"tolerance", parameters.tolerance},
            {"stabilization", stabilization_of(parameters)},
            {"cycles", parameters.cycles},
            {"threads", parameters.threads}};
}

const char* stop_name(Stop stop) {
    if (stop == Stop::Vanished) return "vanished";
    if (stop == Stop::Pinched) return "pinched";
    return stop == Stop::NothingMoves ? "nothing moves" : "none";
}

Json step_json(const StepReport& step, Solver solver) {
    const bool knows_tolerance = solver == Solver::Converged;
    return {{"assemble_seconds", step.assemble_seconds},
            {"solve_seconds", step.solve_seconds},
            {"residual_before", step.residual_before},
            {"residual_after", step.residual_after},
            {"solver_iterations", step.solver_iterations},
            {"relative_residual", knows_tolerance ? Json(step.relative_residual) : Json()},
            {"reached_tolerance", knows_tolerance ? Json(step.reached_tolerance) : Json()},
            {"area", step.area},
            {"collapsed_samples", step.collapsed_samples}};
}

/// How the steps were solved, such as "4 to 6 iterations of conjugate gradients".
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

std::string report_json(const CommandLine& line, const FlowReport& report) {
    Json steps = Json::array();
    for (const StepReport& step : report.steps) {
        steps.push_back(step_json(step, line.parameters.solver));
    }
    const Json json = {{"program", "tracked_mcf"},
                       {"version", program_version()},
                       {"input", line.input.string()},
                       {"output", line.output.string()},
                       {"parameters", parameters_json(line)},
                       {"vertices", report.vertices},
                       {"triangles", report.triangles},
                       {"degenerate_triangles", report.degenerate_triangles},
                       {"boundary_edges", report.boundary_edges},
                       {"held_vertices", report.held_vertices},
                       {"depth", report.depth},
                       {"cell_size", report.cell_size},
                       {"cells", report.cells},
                       {"elements", report.elements},
                       {"unknowns", report.unknowns},
                       {"locked_unknowns", report.locked_unknowns},
                       {"fragments", report.fragments},
                       {"split_triangles", report.split_triangles},
                       {"samples", report.samples},
                       {"area_before", report.area_before},
                       {"area_after", report.area_after},
                       {"setup_seconds", report.setup_seconds},
                       {"steps", steps},
                       {"stop", stop_name(report.stop)},
                       {"estimated_memory_bytes", report.estimated_memory_bytes},
                       {"peak_memory_bytes", report.peak_memory_bytes}};
    // File names need not be UTF-8, JSON must be.
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string summary(const CommandLine& line, const FlowReport& report) {
    std::ostringstream text;
    text << line.input.string() << ": " << report.vertices << " vertices, " << report.triangles
         << " triangles";
    if (report.degenerate_triangles > 0) {
        text << ", of which " << report.degenerate_triangles << " have no area";
    }
    text << "\ndepth " << report.depth << ": " << report.cells << " cells, " << report.unknowns
         << " unknowns";
    if (report.locked_unknowns > 0)
        text << ", of which " << report.locked_unknowns << " are locked";
    if (report.held_vertices > 0) text << "\n" << report.held_vertices << " vertices are held";
    if (!report.steps.empty())
        text << "\nsolved by " << effort(line.parameters, report.steps) << " in each step";
    text << "\n"
         << report.steps.size() << (report.steps.size() == 1 ? " step of " : " steps of ")
         << line.parameters.step_size
         << (line.parameters.absolute ? " squared units of the mesh in " : " in ") << std::fixed
         << std::setprecision(1) << total_seconds(report) << " s: " << line.output.string() << "\n";
    return text.str();
}

std::vector<std::string> warnings(const CommandLine& line, const FlowReport& report) {
    std::vector<std::string> result;
    const std::string stop = early_stop(report, line.parameters.iterations);
    if (!stop.empty()) result.push_back(stop);
    const std::string short_steps = shortfall(report, line.parameters.tolerance);
    if (!short_steps.empty()) {
        const char* const advice = stabilization_of(line.parameters) < kDefaultStabilization
                                       ? " Give a larger --stabilization or --tolerance."
                                       : " Give a larger --tolerance or a smaller --step-size.";
        result.push_back(short_steps + advice);
    }
    return result;
}

}  // namespace tracked_mcf
