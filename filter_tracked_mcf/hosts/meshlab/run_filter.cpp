// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/meshlab/run_filter.h"

#include <cstring>
#include <exception>
#include <limits>
#include <new>
#include <optional>
#include <string>
#include <variant>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/presentation/fair_warnings.h"
#include "filter_tracked_mcf/presentation/flow_warnings.h"
#include "filter_tracked_mcf/presentation/noise_warnings.h"
#include "filter_tracked_mcf/presentation/report_table.h"
#include "filter_tracked_mcf/presentation/summary.h"

namespace tracked_mcf {

namespace {

/// Returns the dialog's label of a parameter, or nothing if no dialog of these has it.
template <class Parameters>
std::string label_of(const std::string& name) {
    for (const auto& parameter : parameter_table<Parameters>()) {
        if (parameter.name == name) return parameter.label;
    }
    for (const Input& input : input_table<Parameters>()) {
        if (input.name == name) return input.label;
    }
    return {};
}

/// Returns the message with the parameter's label in the dialog. A name has the same label in all
/// dialogs.
std::string message_of(const InvalidParameter& error) {
    std::string label = label_of<FlowParameters>(error.name);
    if (label.empty()) label = label_of<NoiseParameters>(error.name);
    if (label.empty()) label = label_of<FairParameters>(error.name);
    if (label.empty()) return error.what();
    return std::string(error.what()) + " In the dialog it is \"" + label + "\"." +
           (error.number == 0 ? " MeshLab reads a number with a decimal comma as 0: use a point."
                              : "");
}

}  // namespace

FilterOutcome guard(const std::function<FilterOutcome()>& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        return {false, "There is not enough memory. Choose a smaller depth.", {}};
    } catch (const InvalidParameter& error) {
        return {false, message_of(error), {}};
    } catch (const std::exception& error) {
        return {false, error.what(), {}};
    } catch (...) {
        return {false, "An unknown error occurred.", {}};
    }
}

Progress as_progress(HostCallback* callback) {
    if (callback == nullptr) return {};
    return [callback](double fraction, std::string_view phase) {
        return callback(static_cast<int>(100 * fraction), std::string(phase).c_str());
    };
}

namespace run_filter_detail {

namespace {

/// Returns a value as MeshLab knows it, or nothing if it is no number.
std::optional<Outputs::mapped_type> as_output(const ReportValue& value) {
    if (std::holds_alternative<std::monostate>(value.value))
        return std::numeric_limits<double>::quiet_NaN();
    if (const auto* const is_so = std::get_if<bool>(&value.value)) return *is_so ? 1 : 0;
    if (const auto* const number = std::get_if<double>(&value.value)) return *number;
    if (const auto* const count = std::get_if<std::int64_t>(&value.value)) {
        if (*count > std::numeric_limits<int>::max()) return static_cast<double>(*count);
        return static_cast<int>(*count);
    }
    return {};
}

}  // namespace

double default_detail_size_or_zero(const TriangleMesh& mesh, const Selection& selection) {
    try {
        return default_detail_size(mesh, selection);
    } catch (const InvalidMesh&) {
        return 0;
    }
}

std::uint64_t checksum(const TriangleMesh& mesh) {
    std::uint64_t sum = 0;
    const auto add = [&sum](const auto& vector) {
        for (const auto number : vector) {
            std::uint64_t bits = 0;
            std::memcpy(&bits, &number, sizeof number);
            sum = (sum ^ bits) * 0x9e3779b97f4a7c15;  // odd, so no bit is lost
            sum ^= sum >> 32;
        }
    };
    for (const Eigen::Vector3d& position : mesh.positions) add(position);
    for (const Triangle& triangle : mesh.triangles) add(triangle);
    return sum;
}

template <class Parameters, class Report>
std::string message_of(const Parameters& parameters, const Report& report) {
    std::string text = summary(parameters, report);
    if (!report.quality.empty())
        text += "\nColorize by vertex Quality shows the new vertex quality.";
    for (const std::string& warning : warnings_of(parameters, report))
        text += "\nWarning: " + warning;
    return text;
}

template std::string message_of(const FlowParameters&, const FlowReport&);
template std::string message_of(const NoiseParameters&, const NoiseReport&);
template std::string message_of(const FairParameters&, const FairReport&);

template <class Report>
Outputs outputs_of(const Report& report) {
    Outputs outputs;
    for (const auto& [name, value] : values_of(report)) {
        if (const auto output = as_output(value)) outputs.emplace(name, *output);
    }
    return outputs;
}

template Outputs outputs_of(const FlowReport&);
template Outputs outputs_of(const NoiseReport&);
template Outputs outputs_of(const FairReport&);

}  // namespace run_filter_detail

}  // namespace tracked_mcf
