// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/presentation/report_table.h"

#include <cmath>
#include <functional>
#include <type_traits>

#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/presentation/flow_warnings.h"

namespace tracked_mcf {

namespace {

// What keys of several reports mean.
constexpr const char* kDetailSize =
    "bumps of this size became half as high, smaller ones nearly vanished";
constexpr const char* kStop =
    "why the flow ended early: `vanished`, `pinched`, `volume not preserved`, `step failed`, `area "
    "grew` or `nothing moves`; or why no noise was removed: `nothing moves`, `too few vertices`, "
    "`too many creases` or `no noise`; else `none`";
constexpr const char* kSolverIterations =
    "iterations of the linear solvers, or W-cycles; of a flow in each step, else in all";

std::string name_of(Stop stop) {
    switch (stop) {
        case Stop::None:
            break;
        case Stop::Vanished:
            return "vanished";
        case Stop::Pinched:
            return "pinched";
        case Stop::NotPreserved:
            return "volume not preserved";
        case Stop::StepFailed:
            return "step failed";
        case Stop::Grew:
            return "area grew";
        case Stop::NothingMoves:
            return "nothing moves";
    }
    return "none";
}

std::string name_of(NoiseStop stop) {
    switch (stop) {
        case NoiseStop::None:
            break;
        case NoiseStop::NothingMoves:
            return "nothing moves";
        case NoiseStop::TooFewVertices:
            return "too few vertices";
        case NoiseStop::TooManyCreases:
            return "too many creases";
        case NoiseStop::ModelledPart:
            return "modelled part";
        case NoiseStop::TooMuchLost:
            return "too much lost";
        case NoiseStop::NoNoise:
            return "no noise";
    }
    return "none";
}

std::string name_of(NoiseKind kind) {
    switch (kind) {
        case NoiseKind::None:
            break;
        case NoiseKind::White:
            return "white";
        case NoiseKind::Varying:
            return "varying";
        case NoiseKind::Outliers:
            return "outliers";
        case NoiseKind::Shared:
            return "shared";
        case NoiseKind::Stairs:
            return "stairs";
    }
    return "none";
}

/// Returns a member of a report as a value. A number that means nothing is null.
template <class Value>
ReportValue as_value(const Value& value) {
    if constexpr (std::is_enum_v<Value>) {
        return {name_of(value)};
    } else if constexpr (std::is_same_v<Value, double>) {
        return std::isnan(value) ? ReportValue() : ReportValue{value};
    } else if constexpr (std::is_same_v<Value, int>) {
        return {std::int64_t{value}};
    } else {
        return {value};
    }
}

ReportValue as_value(const std::vector<StepReport>& steps) {
    ReportList list;
    list.reserve(steps.size());
    for (const StepReport& step : steps) list.push_back({values_of(step)});
    return {list};
}

/// Returns the type of as_value() in Python.
template <class Value>
std::string type_of() {
    if constexpr (std::is_enum_v<Value>) return "str";
    if constexpr (std::is_same_v<Value, bool>) return "bool";
    if constexpr (std::is_same_v<Value, double>) return "float";
    if constexpr (std::is_same_v<Value, std::vector<StepReport>>) return "List[StepReport]";
    return "int";
}

/// Adds rows to the table of a report.
template <class Report>
class Table {
public:
    /// A row of a function of the report.
    template <class Function>
    Table& add(const char* name, const Function& of, Unit unit, const char* meaning) {
        using Value = std::decay_t<std::invoke_result_t<Function, const Report&>>;
        ReportRow<Report> row;
        row.name = name;
        row.type = type_of<Value>();
        row.unit = unit;
        row.meaning = meaning;
        row.value = [of](const Report& report) { return as_value(std::invoke(of, report)); };
        rows_.push_back(std::move(row));
        return *this;
    }

    /// The same of a value that may be null.
    template <class Function>
    Table& add_optional(const char* name, const Function& of, Unit unit, const char* meaning) {
        add(name, of, unit, meaning);
        rows_.back().type = "Optional[" + rows_.back().type + "]";
        return *this;
    }

    std::vector<ReportRow<Report>> rows() { return std::move(rows_); }

private:
    std::vector<ReportRow<Report>> rows_;
};

/// Adds what all filters report of the surface before they begin.
template <class Report>
void add_surface(Table<Report>& table) {
    table
        .add("vertices", &FilterReport::vertices, Unit::None,
             "vertices of the faces that may move, or of *Fair Selected Faces* those that may move "
             "themselves; coincident ones count once")
        .add("triangles", &FilterReport::triangles, Unit::None, "faces that may move")
        .add("degenerate_triangles", &FilterReport::degenerate_triangles, Unit::None,
             "of these, faces without an area: they have no influence")
        .add("copied_triangles", &FilterReport::copied_triangles, Unit::None,
             "of these, faces with the same vertices as another one: all of them count once")
        .add("double_sided_parts", &FilterReport::double_sided_parts, Unit::None,
             "connected parts of the surface whose faces have copies that look the other way")
        .add(
            "joined_vertices", [](const Report& report) { return report.cracks.joined_vertices; },
            Unit::None, "vertices that count as one with another across a crack")
        .add(
            "open_pairs", [](const Report& report) { return report.cracks.open_pairs; }, Unit::None,
            "pairs of vertices at cracks that are too wide for that");
}

/// Adds what the filters that smooth report of the surface, too.
template <class Report>
void add_boundary(Table<Report>& table) {
    table
        .add("boundary_edges", &SmoothingReport::boundary_edges, Unit::None,
             "sides of these faces on the rim of an open mesh")
        .add("held_vertices", &SmoothingReport::held_vertices, Unit::None,
             "of the vertices, those that keep their bits");
}

/// Adds what all filters report of what they have done.
template <class Report>
void add_change(Table<Report>& table) {
    table
        .add("largest_displacement", &FilterReport::largest_displacement, Unit::Length,
             "how far a vertex has moved at most")
        .add("rms_displacement", &FilterReport::rms_displacement, Unit::Length,
             "root mean square of how far the vertices have moved")
        .add("area_before", &FilterReport::area_before, Unit::SquaredLength,
             "area of these faces before")
        .add("area_after", &FilterReport::area_after, Unit::SquaredLength,
             "area of these faces after")
        .add_optional("volume_before", &FilterReport::volume_before, Unit::CubedLength,
                      "enclosed volume; null unless all of a closed mesh may move")
        .add_optional(
            "volume_after",
            [](const Report& report) { return report.volume_before + report.volume_change; },
            Unit::CubedLength, "the same after")
        .add_optional("volume_change", &FilterReport::volume_change, Unit::CubedLength,
                      "volume between the surface before and after, positive along the normals; "
                      "null if the faces cannot be oriented alike")
        .add("seconds", &FilterReport::seconds, Unit::Seconds, "wall time without files")
        .add("peak_memory_bytes", &FilterReport::peak_memory_bytes, Unit::Bytes,
             "peak memory of the whole process so far");
}

/// Returns the error of the last step.
double error_estimate(const FlowReport& report) {
    if (report.steps.empty()) return 0;
    const StepReport& step = report.steps.back();
    if (!std::isnan(step.error_estimate)) return step.error_estimate;
    return step.residual_before == 0 ? 0 : step.residual_after / step.residual_before;
}

int made_steps(const FlowReport& report) {
    return static_cast<int>(report.steps.size());
}

std::vector<ReportRow<FlowReport>> flow_rows() {
    Table<FlowReport> table;
    add_surface(table);
    add_boundary(table);
    table.add("detail_size", &FlowReport::detail_size, Unit::Length, kDetailSize)
        .add("step_size", &FlowReport::step_size, Unit::SquaredLength, "the time step δ")
        .add("depth", &FlowReport::depth, Unit::None, "of the octree; 0 if none was needed")
        .add("cell_size", &FlowReport::cell_size, Unit::Length, "side of the octree's finest cells")
        .add("cells", &FlowReport::cells, Unit::None, "finest cells that the surface meets")
        .add("elements", &FlowReport::elements, Unit::None, "finite elements of the finest level")
        .add("unknowns", &FlowReport::unknowns, Unit::None, "size of the system")
        .add("constrained_unknowns", &FlowReport::constrained_unknowns, Unit::None,
             "of these, unknowns in cells that a locked rim meets, with the method *Paper*")
        .add("fragments", &FlowReport::fragments, Unit::None,
             "parts of faces in cells, with the method *Paper*")
        .add("split_triangles", &FlowReport::split_triangles, Unit::None,
             "triangles of which the fragments consist")
        .add("samples", &FlowReport::samples, Unit::None, "quadrature points on these")
        .add("iterations", made_steps, Unit::None,
             "steps that were made: fewer than the parameter if the flow ended early")
        .add("stop", &FlowReport::stop, Unit::None, kStop)
        .add(
            "stopped_early", [](const FlowReport& report) { return report.stop != Stop::None; },
            Unit::None, "whether the flow ended early")
        .add("converged", converged, Unit::None, "whether all steps reached the tolerance")
        .add("error_estimate", error_estimate, Unit::Share,
             "of the last step: largest relative error of a solve in the energy norm, or with the "
             "method *Paper* the "
             "residual's 2-norm relative to its first value; 0 without a step")
        .add("setup_seconds", &FlowReport::setup_seconds, Unit::Seconds, "before the first step")
        .add("steps", &FlowReport::steps, Unit::None, "one entry for each step, see below")
        .add("estimated_memory_bytes", &FlowReport::estimated_memory_bytes, Unit::Bytes,
             "the peak that was expected before the flow began");
    add_change(table);
    return table.rows();
}

std::vector<ReportRow<NoiseReport>> noise_rows() {
    Table<NoiseReport> table;
    add_surface(table);
    add_boundary(table);
    table.add("detail_size", &NoiseReport::detail_size, Unit::Length, kDetailSize)
        .add("stop", &NoiseReport::stop, Unit::None, kStop)
        .add("kind", &NoiseReport::kind, Unit::None,
             "what was removed: `none`, `white`, `varying`, `outliers`, `shared` or `stairs`")
        .add("noise", &NoiseReport::noise, Unit::Length,
             "standard deviation of the noise along the normals, as measured; 0 if too few "
             "vertices can move")
        .add("noise_size", &NoiseReport::noise_size, Unit::Length,
             "how wide what counts as noise is: an edge, what was given, or what the mesh shows")
        .add("outliers", &NoiseReport::outliers, Unit::None,
             "vertices with so much more noise than others that they hardly counted")
        .add("stairs", &NoiseReport::stairs, Unit::Length,
             "height of stairs, as of voxels or slices; 0 if there are none")
        .add("cell_x", &NoiseReport::cell_x, Unit::Length,
             "side of voxels or slices along x, or most nearly so; 0 if there are none")
        .add("cell_y", &NoiseReport::cell_y, Unit::Length, "the same along y")
        .add("cell_z", &NoiseReport::cell_z, Unit::Length, "the same along z")
        .add_optional("voxels", &NoiseReport::voxels, Unit::None,
                      "those inside the labels that were smoothed; null if there are none, or if a "
                      "label is open")
        .add("flat_edges", &NoiseReport::flat_edges, Unit::Share,
             "share of edges that are exactly flat, beside those in flat places; noise leaves "
             "hardly "
             "any")
        .add_optional("evenness", &NoiseReport::evenness, Unit::Share,
                      "height of bumps in the quietest tenth of places, over the median: near 0.9 "
                      "with noise, less with detail; null if it was not measured")
        .add("crease_share", &NoiseReport::crease_share, Unit::Share,
             "share of the area in triangles that a crease crosses")
        .add_optional("median_turn", &NoiseReport::median_turn, Unit::Degrees,
                      "angle by which half of the area turns across a triangle; null unless "
                      "creases are too many")
        .add("smoothing_steps", &NoiseReport::smoothing_steps, Unit::None, "steps that smooth")
        .add("sharpening_steps", &NoiseReport::sharpening_steps, Unit::None,
             "steps of the bilateral filter of normals after these")
        .add("solver_iterations", &NoiseReport::solver_iterations, Unit::None, kSolverIterations)
        .add("bounded_vertices", &NoiseReport::bounded_vertices, Unit::None,
             "vertices that stopped at the largest movement")
        .add(
            "shrunken_parts", &NoiseReport::shrunken_parts, Unit::None,
            "connected parts that lose more than 3 % of their area or volume, besides their noise, "
            "or of whose area more than 0.5 % turns over")
        .add("kept_parts", &NoiseReport::kept_parts, Unit::None,
             "those that were left as they were, because nobody said what the noise is")
        .add("turned_triangles", &NoiseReport::turned_triangles, Unit::None,
             "faces that smoothing turned over, in kept parts, too")
        .add("lost_area", &NoiseReport::lost_area, Unit::Share,
             "the largest share of its area that a part loses, kept parts included")
        .add("lost_volume", &NoiseReport::lost_volume, Unit::Share,
             "the largest share by which the volume of a part changes, kept parts included");
    add_change(table);
    return table.rows();
}

std::vector<ReportRow<FairReport>> fair_rows() {
    Table<FairReport> table;
    add_surface(table);
    table.add("patches", &FairReport::patches, Unit::None, "patches that were faired")
        .add("flatter_patches", &FairReport::flatter_patches, Unit::None,
             "patches that have less continuity than was asked for, because their surroundings do "
             "not tell more")
        .add("rough_patches", &FairReport::rough_patches, Unit::None,
             "patches whose surroundings turn so much from vertex to vertex that chance may have "
             "raised them: the membrane may be closer")
        .add("seam_curvature", &FairReport::seam_curvature, Unit::InverseLength,
             "RMS mean curvature around the patches")
        .add("patch_curvature", &FairReport::patch_curvature, Unit::InverseLength,
             "RMS mean curvature in the patches")
        .add("height", &FairReport::height, Unit::Share,
             "largest distance from the membrane, relative to the diameter of the hole; at most 1")
        .add("passes", &FairReport::passes, Unit::None,
             "solves in a new metric, of the patch that took most");
    add_change(table);
    return table.rows();
}

std::vector<ReportRow<StepReport>> step_rows() {
    Table<StepReport> table;
    table
        .add("assemble_seconds", &StepReport::assemble_seconds, Unit::Seconds,
             "for matrices and right-hand sides")
        .add("solve_seconds", &StepReport::solve_seconds, Unit::Seconds, "for the solver")
        .add("residual_before", &StepReport::residual_before, Unit::Share,
             "2-norm of the residual before the solve, in edges or cells")
        .add("residual_after", &StepReport::residual_after, Unit::Share, "the same after it")
        .add("solver_iterations", &StepReport::solver_iterations, Unit::None, kSolverIterations)
        .add_optional(
            "error_estimate", &StepReport::error_estimate, Unit::Share,
            "largest relative error of a solve in the energy norm; null with the method *Paper*")
        .add("reached_tolerance", &StepReport::reached_tolerance, Unit::None,
             "whether that is at most the tolerance, or the method has none")
        .add("area", &StepReport::area, Unit::SquaredLength, "before the step")
        .add("collapsed_samples", &StepReport::collapsed_samples, Unit::None,
             "quadrature points whose area has collapsed");
    return table.rows();
}

ReportValue parameter_value(const Parameter& parameter, const ParameterValue& value) {
    if (parameter.type == Parameter::Type::Choice) {
        return {parameter.choices.at(std::get<int>(value)).name};
    }
    if (const int* number = std::get_if<int>(&value)) return {std::int64_t{*number}};
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

}  // namespace

template <>
const std::vector<ReportRow<FlowReport>>& report_table() {
    static const auto rows = flow_rows();
    return rows;
}

template <>
const std::vector<ReportRow<NoiseReport>>& report_table() {
    static const auto rows = noise_rows();
    return rows;
}

template <>
const std::vector<ReportRow<FairReport>>& report_table() {
    static const auto rows = fair_rows();
    return rows;
}

template <>
const std::vector<ReportRow<StepReport>>& report_table() {
    static const auto rows = step_rows();
    return rows;
}

std::string unit_in_words(Unit unit) {
    switch (unit) {
        case Unit::None:
        case Unit::Share:
            break;
        case Unit::Length:
            return "units of the mesh";
        case Unit::SquaredLength:
            return "squared units of the mesh";
        case Unit::CubedLength:
            return "cubed units of the mesh";
        case Unit::InverseLength:
            return "1 / units of the mesh";
        case Unit::Degrees:
            return "degrees";
        case Unit::Seconds:
            return "seconds";
        case Unit::Bytes:
            return "bytes";
    }
    return {};
}

template <class Parameters, class Report>
ReportObject report_values(const Parameters& parameters, const ReportObject& inputs,
                           const Report& report, const std::vector<std::string>& warnings) {
    ReportObject values{{"parameters", {parameter_values(parameters, inputs)}}};
    for (auto& value : values_of(report)) values.push_back(std::move(value));
    ReportList texts;
    texts.reserve(warnings.size());
    for (const std::string& warning : warnings) texts.push_back({warning});
    values.emplace_back("warnings", ReportValue{texts});
    return values;
}

template ReportObject report_values(const FlowParameters&, const ReportObject&, const FlowReport&,
                                    const std::vector<std::string>&);
template ReportObject report_values(const NoiseParameters&, const ReportObject&, const NoiseReport&,
                                    const std::vector<std::string>&);
template ReportObject report_values(const FairParameters&, const ReportObject&, const FairReport&,
                                    const std::vector<std::string>&);

}  // namespace tracked_mcf
