#include "filter_tracked_mcf/tool/report_json.h"

#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

namespace tracked_mcf {

namespace {

using Json = nlohmann::ordered_json;

Json parameters_json(const FlowParameters& parameters) {
    return {{"depth", parameters.depth},
            {"step_size", parameters.step_size},
            {"iterations", parameters.iterations},
            {"boundary", boundary_name(parameters.boundary)},
            {"cubature", cubature_name(parameters.cubature)},
            {"cycles", parameters.cycles},
            {"threads", parameters.threads}};
}

Json step_json(const StepReport& step) {
    return {{"assemble_seconds", step.assemble_seconds},
            {"solve_seconds", step.solve_seconds},
            {"residual_before", step.residual_before},
            {"residual_after", step.residual_after},
            {"area", step.area},
            {"collapsed_samples", step.collapsed_samples}};
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
    for (const StepReport& step : report.steps) steps.push_back(step_json(step));
    const Json json = {{"program", "tracked_mcf"},
                       {"version", program_version()},
                       {"input", line.input.string()},
                       {"output", line.output.string()},
                       {"parameters", parameters_json(line.parameters)},
                       {"vertices", report.vertices},
                       {"triangles", report.triangles},
                       {"degenerate_triangles", report.degenerate_triangles},
                       {"boundary_edges", report.boundary_edges},
                       {"depth", report.depth},
                       {"cell_size", report.cell_size},
                       {"cells", report.cells},
                       {"unknowns", report.unknowns},
                       {"locked_unknowns", report.locked_unknowns},
                       {"fragments", report.fragments},
                       {"split_triangles", report.split_triangles},
                       {"samples", report.samples},
                       {"setup_seconds", report.setup_seconds},
                       {"steps", steps},
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
    text << "\n"
         << report.steps.size() << " steps of " << line.parameters.step_size << " in " << std::fixed
         << std::setprecision(1) << total_seconds(report) << " s: " << line.output.string() << "\n";
    return text.str();
}

}  // namespace tracked_mcf
