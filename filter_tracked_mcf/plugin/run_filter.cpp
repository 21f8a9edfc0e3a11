// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/plugin/run_filter.h"

#include <cstring>
#include <exception>
#include <limits>
#include <new>
#include <numeric>
#include <sstream>
#include <string>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/parameters/fair_warnings.h"
#include "filter_tracked_mcf/parameters/flow_warnings.h"
#include "filter_tracked_mcf/parameters/noise_warnings.h"

namespace tracked_mcf {

namespace {

/// Returns the dialog's label of a parameter, or nothing if no dialog of these has it.
template <class Parameters>
std::string label_of(const std::string& name) {
    for (const auto& parameter : parameter_table<Parameters>()) {
        if (parameter.name == name) return parameter.label;
    }
    return {};
}

/// Appends the dialog's label of the parameter whose name begins the message. A name has the same
/// label in all dialogs.
std::string with_label(const std::string& message) {
    const std::string name = message.substr(0, message.find(' '));
    std::string label = label_of<FlowParameters>(name);
    if (label.empty()) label = label_of<NoiseParameters>(name);
    if (label.empty()) label = label_of<FairParameters>(name);
    if (label.empty()) return message;
    const bool is_zero = message.rfind(name + " is 0;", 0) == 0;
    return message + " In the dialog it is \"" + label + "\"." +
           (is_zero ? " MeshLab reads a number with a decimal comma as 0: use a point." : "");
}

}  // namespace

FilterOutcome guard(const std::function<FilterOutcome()>& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
        return {false, "There is not enough memory. Choose a smaller depth.", {}};
    } catch (const InvalidParameter& error) {
        return {false, with_label(error.what()), {}};
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

const char* const kAdvice = "Look at the result; a smaller detail size or depth may help.";

double seconds_of(const std::vector<StepReport>& steps) {
    return std::accumulate(steps.begin(), steps.end(), 0.0, [](double sum, const StepReport& step) {
        return sum + step.assemble_seconds + step.solve_seconds;
    });
}

std::string after_summary(const std::vector<std::string>& warnings) {
    std::string text;
    for (const std::string& warning : warnings) text += " Warning: " + warning;
    return text;
}

template <class Report>
double volume_change(const Report& report) {
    return report.oriented_consistently ? report.volume_change
                                        : std::numeric_limits<double>::quiet_NaN();
}

std::string constrained(std::int64_t count) {
    return count > 0 ? " (" + std::to_string(count) + " constrained)" : "";
}

double error_estimate(Solver solver, const StepReport& step) {
    if (solver == Solver::Converged) return step.error_estimate;
    return step.residual_before == 0 ? 0 : step.residual_after / step.residual_before;
}

}  // namespace

double default_detail_size_or_zero(const TriangleMesh& mesh, const Selection& selection) {
    try {
        validate(mesh);
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

std::string summary(const FlowParameters& parameters, const FlowReport& report) {
    std::ostringstream text;
    text.precision(3);
    text << "Smoothed " << report.vertices << " vertices"
         << constrained(report.constrained_vertices) << " by " << report.steps.size()
         << (report.steps.size() == 1 ? " step" : " steps") << " of "
         << (parameters.flow == FlowKind::Conformalized ? "conformalized " : "")
         << "mean-curvature flow: depth " << report.depth << ", " << report.unknowns << " unknowns"
         << constrained(report.constrained_unknowns) << ", " << report.setup_seconds
         << " s for the set-up and " << seconds_of(report.steps) << " s for the steps. "
         << changes(report);
    if (report.degenerate_triangles > 0) {
        text << " " << report.degenerate_triangles << " faces have zero area and were ignored.";
    }
    return text.str() + after_summary(warnings_of(parameters, report, kAdvice));
}

std::string summary(const NoiseParameters& parameters, const NoiseReport& report) {
    std::ostringstream text;
    text.precision(3);
    text << "Removed noise from " << report.vertices << " vertices"
         << constrained(report.constrained_vertices) << " in " << report.seconds << " s. "
         << changes(report) << after_summary(warnings_of(parameters, report, kAdvice));
    return text.str();
}

std::string summary(const FairParameters& parameters, const FairReport& report) {
    std::ostringstream text;
    text.precision(3);
    text << "Faired " << report.vertices << " vertices of " << report.patches
         << (report.patches == 1 ? " patch" : " patches") << " in " << report.seconds << " s. "
         << changes(report) << after_summary(warnings_of(parameters, report, kAdvice));
    return text.str();
}

Outputs outputs_of(const FlowParameters& parameters, const FlowReport& report) {
    const double error =
        report.steps.empty() ? 0 : error_estimate(parameters.solver, report.steps.back());
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
            {"crease_share", report.crease_share},
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
