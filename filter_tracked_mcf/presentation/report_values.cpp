// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/presentation/report_values.h"

#include <algorithm>

#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/presentation/flow_warnings.h"

namespace tracked_mcf {

namespace {

ReportValue integer(std::int64_t number) {
    return {number};
}

ReportValue unless(bool unknown, const ReportValue& value) {
    return unknown ? ReportValue() : value;
}

/// Returns the name of a choice, or its number if that is its name.
ReportValue choice_value(const std::string& name) {
    const bool is_number = std::all_of(name.begin(), name.end(),
                                       [](char letter) { return letter >= '0' && letter <= '9'; });
    if (is_number) return integer(std::stoi(name));
    return {name};
}

ReportValue parameter_value(const Parameter& parameter, const ParameterValue& value) {
    if (parameter.type == Parameter::Type::Choice) {
        return choice_value(parameter.choices.at(std::get<int>(value)).name);
    }
    if (const int* number = std::get_if<int>(&value)) return integer(*number);
    if (const bool* is_on = std::get_if<bool>(&value)) return {*is_on};
    return {std::get<double>(value)};
}

/// Returns all parameters of a filter, and the inputs.
template <class Parameters>
ReportObject parameter_values(const Parameters& parameters, const ReportObject& inputs) {
    ReportObject values;
    for (const auto& row : parameter_table<Parameters>())
        values.emplace_back(row.name, parameter_value(row, row.get(parameters)));
    values.insert(values.end(), inputs.begin(), inputs.end());
    return values;
}

ReportList texts(const std::vector<std::string>& lines) {
    ReportList list;
    for (const std::string& line : lines) list.push_back({line});
    return list;
}

ReportValue stop_name(Stop stop) {
    const auto name = [stop]() -> const char* {
        if (stop == Stop::Vanished) return "vanished";
        if (stop == Stop::Pinched) return "pinched";
        if (stop == Stop::StepFailed) return "step failed";
        if (stop == Stop::Grew) return "area grew";
        if (stop == Stop::NotPreserved) return "volume not preserved";
        return stop == Stop::NothingMoves ? "nothing moves" : "none";
    };
    return {std::string(name())};
}

ReportValue stop_name(NoiseStop stop) {
    const auto name = [stop]() -> const char* {
        if (stop == NoiseStop::NothingMoves) return "nothing moves";
        if (stop == NoiseStop::TooFewVertices) return "too few vertices";
        if (stop == NoiseStop::TooManyCreases) return "too many creases";
        return stop == NoiseStop::NoNoise ? "no noise" : "none";
    };
    return {std::string(name())};
}

ReportValue step_values(const StepReport& step, Method method) {
    const bool no_tolerance = method == Method::Paper;
    return {ReportObject{{"assemble_seconds", {step.assemble_seconds}},
                         {"solve_seconds", {step.solve_seconds}},
                         {"residual_before", {step.residual_before}},
                         {"residual_after", {step.residual_after}},
                         {"solver_iterations", integer(step.solver_iterations)},
                         {"error_estimate", unless(no_tolerance, {step.error_estimate})},
                         {"reached_tolerance", unless(no_tolerance, {step.reached_tolerance})},
                         {"area", {step.area}},
                         {"collapsed_samples", {step.collapsed_samples}}}};
}

}  // namespace

ReportObject report_values(const FlowParameters& parameters, const ReportObject& inputs,
                           const FlowReport& report, const std::vector<std::string>& warnings) {
    ReportList steps;
    for (const StepReport& step : report.steps)
        steps.push_back(step_values(step, parameters.method));
    return {{"parameters", {parameter_values(parameters, inputs)}},
            {"vertices", {report.vertices}},
            {"triangles", {report.triangles}},
            {"degenerate_triangles", {report.degenerate_triangles}},
            {"boundary_edges", {report.boundary_edges}},
            {"joined_vertices", {report.cracks.joined_vertices}},
            {"open_pairs", {report.cracks.open_pairs}},
            {"constrained_vertices", {report.constrained_vertices}},
            {"detail_size", {report.detail_size}},
            {"step_size", {report.step_size}},
            {"depth", integer(report.depth)},
            {"cell_size", {report.cell_size}},
            {"cells", {report.cells}},
            {"elements", {report.elements}},
            {"unknowns", {report.unknowns}},
            {"constrained_unknowns", {report.constrained_unknowns}},
            {"fragments", {report.fragments}},
            {"split_triangles", {report.split_triangles}},
            {"samples", {report.samples}},
            {"area_before", {report.area_before}},
            {"area_after", {report.area_after}},
            {"volume_before", unless(report.volume_before == 0, {report.volume_before})},
            {"volume_after",
             unless(report.volume_before == 0, {report.volume_before + report.volume_change})},
            {"volume_change", unless(!report.oriented_consistently, {report.volume_change})},
            {"largest_displacement", {report.largest_displacement}},
            {"rms_displacement", {report.rms_displacement}},
            {"setup_seconds", {report.setup_seconds}},
            {"steps", {steps}},
            {"converged", {converged(report)}},
            {"stop", stop_name(report.stop)},
            {"warnings", {texts(warnings)}},
            {"estimated_memory_bytes", {report.estimated_memory_bytes}},
            {"peak_memory_bytes", {report.peak_memory_bytes}}};
}

ReportObject report_values(const NoiseParameters& parameters, const ReportObject& inputs,
                           const NoiseReport& report, const std::vector<std::string>& warnings) {
    return {{"parameters", {parameter_values(parameters, inputs)}},
            {"vertices", {report.vertices}},
            {"triangles", {report.triangles}},
            {"degenerate_triangles", {report.degenerate_triangles}},
            {"boundary_edges", {report.boundary_edges}},
            {"joined_vertices", {report.cracks.joined_vertices}},
            {"open_pairs", {report.cracks.open_pairs}},
            {"constrained_vertices", {report.constrained_vertices}},
            {"stop", stop_name(report.stop)},
            {"noise", {report.noise}},
            {"noise_size", {report.noise_size}},
            {"outliers", {report.outliers}},
            {"stairs", {report.stairs}},
            {"lump_width", {report.lump_width}},
            {"lump_height", {report.lump_height}},
            {"crease_share", {report.crease_share}},
            {"median_turn", unless(report.median_turn == 0, {report.median_turn})},
            {"detail_size", {report.detail_size}},
            {"steps", integer(report.steps)},
            {"sharpenings", integer(report.sharpenings)},
            {"iterations", integer(report.iterations)},
            {"area_before", {report.area_before}},
            {"area_after", {report.area_after}},
            {"volume_before", unless(report.volume_before == 0, {report.volume_before})},
            {"volume_after",
             unless(report.volume_before == 0, {report.volume_before + report.volume_change})},
            {"volume_change", unless(!report.oriented_consistently, {report.volume_change})},
            {"largest_displacement", {report.largest_displacement}},
            {"rms_displacement", {report.rms_displacement}},
            {"bounded_vertices", {report.bounded_vertices}},
            {"shrunken_parts", {report.shrunken_parts}},
            {"lost_area", {report.lost_area}},
            {"lost_volume", {report.lost_volume}},
            {"seconds", {report.seconds}},
            {"warnings", {texts(warnings)}},
            {"peak_memory_bytes", {report.peak_memory_bytes}}};
}

ReportObject report_values(const FairParameters& parameters, const ReportObject& inputs,
                           const FairReport& report, const std::vector<std::string>& warnings) {
    return {{"parameters", {parameter_values(parameters, inputs)}},
            {"vertices", {report.vertices}},
            {"triangles", {report.triangles}},
            {"joined_vertices", {report.cracks.joined_vertices}},
            {"open_pairs", {report.cracks.open_pairs}},
            {"patches", {report.patches}},
            {"flatter_patches", {report.flatter_patches}},
            {"rough_patches", {report.rough_patches}},
            {"seam_curvature", {report.seam_curvature}},
            {"patch_curvature", {report.patch_curvature}},
            {"height", {report.height}},
            {"iterations", integer(report.iterations)},
            {"area_before", {report.area_before}},
            {"area_after", {report.area_after}},
            {"largest_displacement", {report.largest_displacement}},
            {"rms_displacement", {report.rms_displacement}},
            {"seconds", {report.seconds}},
            {"warnings", {texts(warnings)}},
            {"peak_memory_bytes", {report.peak_memory_bytes}}};
}

}  // namespace tracked_mcf
