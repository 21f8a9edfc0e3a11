// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/zoo/reports.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "filter_tracked_mcf/core/mesh/surface.h"

namespace tracked_mcf::zoo {

namespace {

/// Returns the key of this name in a table, or null.
template <class Report>
const ReportKey* key_in(const std::string& name) {
    const auto& rows = report_table<Report>();
    const auto row = std::find_if(rows.begin(), rows.end(),
                                  [&](const ReportKey& key) { return key.name == name; });
    return row == rows.end() ? nullptr : &*row;
}

/// Returns what is known of a key of a filter's report, or null for parameters and warnings.
const ReportKey* key_of(const std::string& name) {
    if (const ReportKey* const key = key_in<FlowReport>(name)) return key;
    if (const ReportKey* const key = key_in<NoiseReport>(name)) return key;
    return key_in<FairReport>(name);
}

/// Returns whether a value is a number as its key allows it: finite, or null.
bool is_number(const ReportValue& value, const ReportKey* key) {
    if (const auto* const number = std::get_if<double>(&value.value)) return std::isfinite(*number);
    const bool may_be_null = key == nullptr || key->type.rfind("Optional", 0) == 0;
    return may_be_null || !std::holds_alternative<std::monostate>(value.value);
}

/// Returns the dimension of a number, as the power of a length; nothing if it is none of these.
std::optional<int> dimension_of(const std::string& name) {
    const ReportKey* const key = key_of(name);
    if (key == nullptr) return {};
    switch (key->unit) {
        case Unit::Length:
            return 1;
        case Unit::SquaredLength:
            return 2;
        case Unit::CubedLength:
            return 3;
        case Unit::InverseLength:
            return -1;
        default:
            return {};
    }
}

/// Estimates from a sample of the vertices, which their order chooses; and what is lost of parts
/// that may be smaller than the solver's tolerance.
const std::set<std::string> kEstimates = {"noise",        "noise_size", "detail_size",
                                          "stairs",       "lump_width", "lump_height",
                                          "crease_share", "lost_area",  "lost_volume"};

/// Shares and counts that must be the same for the same mesh.
const std::set<std::string> kShares = {"crease_share", "lost_area", "lost_volume", "height"};
const std::set<std::string> kCounts = {
    "vertices",           "triangles",      "degenerate_triangles", "copied_triangles",
    "double_sided_parts", "boundary_edges", "joined_vertices",      "held_vertices",
    "unknowns",           "patches"};

std::optional<double> number_of(const ReportValue& value) {
    if (const auto* const number = std::get_if<double>(&value.value)) return *number;
    if (const auto* const count = std::get_if<std::int64_t>(&value.value))
        return static_cast<double>(*count);
    return {};
}

double number_of(const ReportObject& report, const std::string& name) {
    for (const auto& [key, value] : report) {
        if (key == name) return number_of(value).value_or(0);
    }
    return 0;
}

bool is_near(double a, double b, double error) {
    return !(std::abs(a - b) > error);
}

std::string difference(const std::string& name, double a, double b) {
    std::ostringstream text;
    text.precision(10);
    text << name << ' ' << a << " instead of " << b;
    return text.str();
}

}  // namespace

std::string wrong_number(const Case& filtered, const TriangleMesh& after,
                         const ReportObject& report) {
    const TriangleMesh& before = filtered.mesh;
    const Selection& selection = filtered.inputs.selection;
    const Surface surface = surface_of(before);
    const std::vector<std::int32_t>& of_surface = surface.vertices;
    std::map<std::int32_t, double> moved;  // squared, by vertex of a selected triangle
    std::set<Triangle> found;              // copies count once
    double area_before = 0, area_after = 0, size = 0;
    for (std::size_t i = 0; i < before.triangles.size(); ++i) {
        if (!selection.empty() && selection[i] == 0) continue;
        Triangle t = before.triangles[i];
        Triangle key = {of_surface[t[0]], of_surface[t[1]], of_surface[t[2]]};
        if (*std::min_element(key.begin(), key.end()) < 0 || !has_three_vertices(key)) continue;
        // Across a crack, one vertex stands for both.
        for (int k = 0; k < 3; ++k) t[k] = surface.mesh_vertices[key[k]];
        std::sort(key.begin(), key.end());
        if (!found.insert(key).second) continue;
        const auto area = [&](const TriangleMesh& mesh) {
            const Eigen::Vector3d& a = mesh.positions[t[0]];
            return (mesh.positions[t[1]] - a).cross(mesh.positions[t[2]] - a).norm() / 2;
        };
        area_before += area(before);
        area_after += area(after);
        for (const std::int32_t vertex : t) {
            moved[of_surface[vertex]] =
                (after.positions[vertex] - before.positions[vertex]).squaredNorm();
            size = std::max(size, (before.positions[vertex] - before.positions[t[0]]).norm());
        }
    }
    double largest = 0, squares = 0;
    for (const auto& [vertex, square] : moved) {
        largest = std::max(largest, std::sqrt(square));
        squares += square;
    }
    const double vertices = number_of(report, "vertices");
    // fair() counts the vertices that may move, and a strength of 0 leaves triangles out.
    const bool counts_all = !filtered.fair && filtered.inputs.strength.empty();
    if (counts_all && vertices != static_cast<double>(moved.size()))
        return difference("vertices", vertices, static_cast<double>(moved.size()));
    const double rms = std::sqrt(squares / vertices), given = number_of(report, "rms_displacement");
    const double rounding = 1e-9 * (largest + size);
    if (!is_near(given, rms, rounding)) return difference("rms_displacement", given, rms);
    const double given_largest = number_of(report, "largest_displacement");
    if (!is_near(given_largest, largest, rounding))
        return difference("largest_displacement", given_largest, largest);
    if (!filtered.inputs.strength.empty()) return {};
    for (const auto& [name, area] :
         {std::pair{"area_before", area_before}, std::pair{"area_after", area_after}}) {
        const double reported = number_of(report, name);
        // The area of a needle is rounded, by which corner comes first.
        const double rounded = 1e-15 * size * size * static_cast<double>(found.size());
        if (!is_near(reported, area, 1e-9 * area_before + rounded))
            return difference(name, reported, area);
    }
    return {};
}

std::string key_without_number(const ReportObject& report) {
    for (const auto& [name, value] : report) {
        if (!is_number(value, key_of(name))) return name;
        if (name != "steps") continue;
        for (const ReportValue& step : std::get<ReportList>(value.value)) {
            for (const auto& [key, of_step] : std::get<ReportObject>(step.value)) {
                if (!is_number(of_step, key_in<StepReport>(key))) return "steps: " + key;
            }
        }
    }
    return {};
}

std::string differing_number(const ReportObject& report, const ReportObject& other, double unit,
                             double size, double tolerance, bool is_reordered) {
    for (std::size_t i = 0; i < report.size(); ++i) {
        const auto& [name, value] = report[i];
        const std::optional<int> dimension = dimension_of(name);
        if (const auto* const text = std::get_if<std::string>(&value.value)) {
            const auto* const others = std::get_if<std::string>(&other[i].second.value);
            if (!others || *text != *others) return name + ' ' + *text;
        }
        if (is_reordered && kEstimates.count(name) > 0) continue;
        if (!dimension && kShares.count(name) + kCounts.count(name) == 0) continue;
        const double scale = std::pow(unit, dimension.value_or(0));
        const std::optional<double> a = number_of(value), b = number_of(other[i].second);
        if (a.has_value() != b.has_value()) return name + " is there in one of both";
        if (!a) continue;
        // What is small beside the mesh is compared with the mesh.
        constexpr double small = 1e-3;
        const double reference =
            std::max(std::abs(*a), small * std::pow(size, dimension.value_or(0)));
        const double error = kCounts.count(name) > 0 ? 0 : tolerance * reference;
        if (!is_near(*b / scale, *a, error)) return difference(name, *b / scale, *a);
    }
    return {};
}

}  // namespace tracked_mcf::zoo
