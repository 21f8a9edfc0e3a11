// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/meshlab/run_filter.h"

#include <cstring>
#include <exception>
#include <limits>
#include <new>
#include <string>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/presentation/fair_warnings.h"
#include "filter_tracked_mcf/presentation/flow_warnings.h"
#include "filter_tracked_mcf/presentation/noise_warnings.h"
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

template <class Report>
double volume_change(const Report& report) {
    return report.oriented_consistently ? report.volume_change
                                        : std::numeric_limits<double>::quiet_NaN();
}

double error_estimate(Method method, const StepReport& step) {
    if (method == Method::Converged) return step.error_estimate;
    return step.residual_before == 0 ? 0 : step.residual_after / step.residual_before;
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

Outputs outputs_of(const FlowParameters& parameters, const FlowReport& report) {
    const double error =
        report.steps.empty() ? 0 : error_estimate(parameters.method, report.steps.back());
    return {{"detail_size", report.detail_size},
            {"step_size", report.step_size},
            {"depth", report.depth},
            {"cell_size", report.cell_size},
            {"unknowns", static_cast<int>(report.unknowns)},
            {"steps", static_cast<int>(report.steps.size())},
            {"stopped_early", report.stop == Stop::None ? 0 : 1},
            {"converged", converged(report) ? 1 : 0},
            {"error_estimate", error},
            {"largest_displacement", report.largest_displacement},
            {"rms_displacement", report.rms_displacement},
            {"area_before", report.area_before},
            {"area_after", report.area_after},
            {"volume_change", volume_change(report)}};
}

Outputs outputs_of(const NoiseParameters& /*parameters*/, const NoiseReport& report) {
    return {{"noise", report.noise},
            {"noise_size", report.noise_size},
            {"outliers", static_cast<int>(report.outliers)},
            {"crease_share", report.crease_share},
            {"stairs", report.stairs},
            {"lump_width", report.lump_width},
            {"lump_height", report.lump_height},
            {"lost_area", report.lost_area},
            {"lost_volume", report.lost_volume},
            {"detail_size", report.detail_size},
            {"steps", report.steps},
            {"largest_displacement", report.largest_displacement},
            {"rms_displacement", report.rms_displacement},
            {"area_before", report.area_before},
            {"area_after", report.area_after},
            {"volume_change", volume_change(report)}};
}

Outputs outputs_of(const FairParameters& /*parameters*/, const FairReport& report) {
    return {{"patches", static_cast<int>(report.patches)},
            {"flatter_patches", static_cast<int>(report.flatter_patches)},
            {"rough_patches", static_cast<int>(report.rough_patches)},
            {"seam_curvature", report.seam_curvature},
            {"patch_curvature", report.patch_curvature},
            {"height", report.height},
            {"largest_displacement", report.largest_displacement},
            {"rms_displacement", report.rms_displacement},
            {"area_before", report.area_before},
            {"area_after", report.area_after}};
}

}  // namespace run_filter_detail

}  // namespace tracked_mcf
