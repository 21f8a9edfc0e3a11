// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "filter_tracked_mcf/core/fair.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/core/remove_noise.h"

namespace tracked_mcf {

struct ReportValue;
using ReportList = std::vector<ReportValue>;
using ReportObject = std::vector<std::pair<std::string, ReportValue>>;

/// A value of a report in any notation: JSON and Python have all these types. std::monostate is
/// null.
struct ReportValue {
    std::variant<std::monostate, bool, std::int64_t, double, std::string, ReportList, ReportObject>
        value;
};

/// What a number of a report measures. Lengths are in units of the mesh.
enum class Unit {
    None,   ///< a count, a name, yes or no
    Share,  ///< a ratio
    Length,
    SquaredLength,  ///< also areas
    CubedLength,    ///< volumes
    InverseLength,  ///< curvatures
    Degrees,
    Seconds,
    Bytes
};

/// What is known of a row of a report's table without the report.
struct ReportKey {
    std::string name;
    std::string type;  ///< as Python has it, such as "float" or "Optional[float]"
    Unit unit = Unit::None;
    std::string meaning;
};

/// One row: a key, and its value in a report.
template <class Report>
struct ReportRow : ReportKey {
    std::function<ReportValue(const Report&)> value;
};

/// Returns all that the reports of a filter, or of a step of a flow, have besides parameters and
/// warnings. A key has the same meaning in all reports.
///
/// To add a number, add a member to the report and a row to the table. The program's report,
/// MeshLab's and PyMeshLab's results, and the Python package's types follow the row.
template <class Report>
const std::vector<ReportRow<Report>>& report_table();

template <>
const std::vector<ReportRow<FlowReport>>& report_table();
template <>
const std::vector<ReportRow<NoiseReport>>& report_table();
template <>
const std::vector<ReportRow<FairReport>>& report_table();
template <>
const std::vector<ReportRow<StepReport>>& report_table();

/// Returns the unit in words, such as "squared units of the mesh"; empty for None and Share.
std::string unit_in_words(Unit unit);

/// Returns the values of all rows.
template <class Report>
ReportObject values_of(const Report& report) {
    ReportObject values;
    for (const ReportRow<Report>& row : report_table<Report>())
        values.emplace_back(row.name, row.value(report));
    return values;
}

/// Returns the parameters and then the `inputs`, the values_of() the report, and the warnings.
template <class Parameters, class Report>
ReportObject report_values(const Parameters& parameters, const ReportObject& inputs,
                           const Report& report, const std::vector<std::string>& warnings);

}  // namespace tracked_mcf
