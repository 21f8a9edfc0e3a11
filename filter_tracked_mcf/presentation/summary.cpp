// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/presentation/summary.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>

namespace tracked_mcf {

namespace {

/// Changes below this many per cent are called none: they are rounding, or too small to matter.
constexpr double kUnchanged = 5e-4;

/// Returns the number with this many digits, without zeros at the end.
std::string digits(double number, int count) {
    std::ostringstream text;
    text.precision(count);
    text << number;
    return text.str();
}

std::string counted(std::int64_t count, const std::string& one, const std::string& many) {
    return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

std::string vertices(std::int64_t count) {
    return counted(count, "vertex", "vertices");
}

std::string faces(std::int64_t count) {
    return counted(count, "face", "faces");
}

std::string steps(std::int64_t count) {
    return counted(count, "step", "steps");
}

std::string relative_change(double before, double change) {
    const double per_cent = 100 * change / before;
    if (std::abs(per_cent) < kUnchanged) return "unchanged";
    return (per_cent > 0 ? "+" : "") + digits(per_cent, 3) + " %";
}

/// Says how far vertices moved, and how the area changed.
template <class Report>
std::string movement(const Report& report) {
    return "\nVertices moved by up to " + digits(report.largest_displacement, 3) + ", RMS " +
           digits(report.rms_displacement, 3) + ".\nArea: " +
           relative_change(report.area_before, report.area_after - report.area_before) + ".";
}

/// The same, and how the volume changed.
template <class Report>
std::string movement_and_volume(const Report& report) {
    const std::string text = movement(report) + " ";
    if (!report.oriented_consistently)
        return text + "Volume: unknown, because the faces are not oriented consistently.";
    if (report.volume_before == 0)  // an open surface
        return text + "Volume swept along the normals: " + digits(report.volume_change, 3) + ".";
    return text + "Volume: " + relative_change(report.volume_before, report.volume_change) + ".";
}

std::string closed_cracks(const CrackReport& cracks) {
    if (cracks.joined_vertices == 0) return {};
    return "\nCracks were closed: " + vertices(cracks.joined_vertices) +
           (cracks.joined_vertices == 1 ? " counts" : " count") +
           " as one with another that is nearer than 1e-6 of the diagonal.";
}

template <class Report>
std::string bystanders(const Report& report) {
    std::string text = closed_cracks(report.cracks);
    if (report.constrained_vertices > 0)
        text += "\n" + vertices(report.constrained_vertices) + " kept their positions.";
    if (report.degenerate_triangles > 0) {
        text += "\n" + faces(report.degenerate_triangles) + " with zero area had no influence.";
    }
    return text;
}

/// Returns the radius of a curvature. What is flat but for rounding has none.
std::string radius(double curvature, double area) {
    constexpr double flat = 1e-6;
    return curvature * std::sqrt(area) < flat ? "infinite" : digits(1 / curvature, 3);
}

double seconds_of(const FlowReport& report) {
    double seconds = report.setup_seconds;
    for (const StepReport& step : report.steps)
        seconds += step.assemble_seconds + step.solve_seconds;
    return seconds;
}

}  // namespace

std::string summary(const FlowParameters& parameters, const FlowReport& report) {
    std::string text = "Smoothed " + vertices(report.vertices) + " by " +
                       steps(static_cast<std::int64_t>(report.steps.size())) + " of " +
                       (parameters.flow == FlowKind::Conformalized ? "conformalized " : "") +
                       "mean-curvature flow in " + digits(seconds_of(report), 2) + " s.";
    if (!report.steps.empty() && report.stop == Stop::None) {
        text += report.has_strengths           ? "\nWhere the strength is 1, detail"
                : parameters.local_detail_size ? "\nAt edges of mean length, detail"
                                               : "\nDetail";
        text += " smaller than " + digits(report.detail_size, 3) + " was removed.";
    }
    if (!report.steps.empty()) text += movement_and_volume(report);
    if (report.unselected_triangles > 0) {
        const std::int64_t selected = report.triangles + report.zero_strength_triangles;
        text += "\nOnly the " + std::to_string(selected) + " selected of " +
                faces(selected + report.unselected_triangles) + " could move.";
    }
    if (report.zero_strength_triangles > 0) {
        text += "\n" + faces(report.zero_strength_triangles) +
                " stayed, because their vertices have strength 0.";
    }
    return text + bystanders(report);
}

std::string summary(const NoiseParameters& parameters, const NoiseReport& report) {
    const bool is_smooth = parameters.boundary == NoiseBoundary::Smooth &&
                           report.boundary_edges > 0 && report.largest_displacement > 0;
    std::string text = (report.steps > 0 ? "Removed noise from "
                        : is_smooth      ? "Smoothed the rim of "
                                         : "Found no noise to remove from ") +
                       vertices(report.vertices) + " in " + digits(report.seconds, 2) + " s.";
    if (report.steps > 0 && is_smooth) text += " The rim was smoothed, too.";
    if (report.steps > 0) {
        if (report.noise > 0)
            text += "\nThe noise along the normals was about " + digits(report.noise, 3) + ".";
        if (report.outliers > 0) {
            text += "\n" + vertices(report.outliers) +
                    " had so much more than others that they hardly counted.";
        }
        if (report.crease_share > 0) {
            text += "\nCreases cross " + digits(100 * report.crease_share, 3) + " % of the area.";
        }
        if (report.detail_size > 0) {
            text += std::string(report.crease_share > 0 ? "\nElsewhere, detail" : "\nDetail") +
                    " smaller than " + digits(report.detail_size, 3) + " was removed.";
        }
    }
    if (report.largest_displacement > 0) text += movement_and_volume(report);
    if (report.bounded_vertices > 0) {
        text += "\n" + vertices(report.bounded_vertices) +
                " moved as far as the largest movement allows.";
    }
    return text + bystanders(report);
}

std::string summary(const FairParameters& /*parameters*/, const FairReport& report) {
    return "Faired " + vertices(report.vertices) + " of " +
           counted(report.patches, "patch", "patches") + " in " + digits(report.seconds, 2) +
           " s.\nMean radius of curvature: " + radius(report.patch_curvature, report.area_before) +
           " in the patches, " + radius(report.seam_curvature, report.area_before) +
           " around them.\nThe patches rise by up to " + digits(100 * report.height, 3) +
           " % of the size of their hole above its membrane." + movement(report) +
           closed_cracks(report.cracks);
}

std::string solver_details(const FlowParameters& parameters, const FlowReport& report) {
    std::ostringstream text;
    text.precision(3);
    if (report.depth > 0) {
        text << "Grid of depth " << report.depth << ": cells " << report.cell_size << " wide, "
             << report.cells << " of them occupied, ";
    }
    text << report.unknowns << " unknowns";
    if (report.constrained_unknowns > 0)
        text << ", of which " << report.constrained_unknowns << " are constrained";
    text << ".\n";
    if (report.steps.empty()) return text.str();
    const auto [least, most] = std::minmax_element(
        report.steps.begin(), report.steps.end(), [](const StepReport& a, const StepReport& b) {
            return a.solver_iterations < b.solver_iterations;
        });
    text << "Step size " << report.step_size << ", in squared units of the mesh, solved by ";
    if (most->solver_iterations > least->solver_iterations)
        text << least->solver_iterations << " to ";
    text << (parameters.method == Method::Paper
                 ? counted(most->solver_iterations, "W-cycle of multigrid", "W-cycles of multigrid")
                 : counted(most->solver_iterations, "iteration of conjugate gradients",
                           "iterations of conjugate gradients"))
         << " in each step.\n";
    return text.str();
}

std::string solver_details(const NoiseParameters& /*parameters*/, const NoiseReport& report) {
    return steps(report.steps) + " with " + std::to_string(report.iterations) +
           " iterations of conjugate gradients, and " + std::to_string(report.sharpenings) +
           " of the bilateral filter.\n";
}

std::string solver_details(const FairParameters& /*parameters*/, const FairReport& report) {
    return counted(report.iterations, "iteration", "iterations") + " of the metric.\n";
}

}  // namespace tracked_mcf
