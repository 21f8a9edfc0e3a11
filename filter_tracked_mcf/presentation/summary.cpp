// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/presentation/summary.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "filter_tracked_mcf/core/plain_text.h"

namespace tracked_mcf {

namespace {

/// Changes below this many per cent are called none: they are rounding, or too small to matter.
constexpr double kUnchanged = 5e-4;

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
    return (per_cent > 0 ? "+" : "") + plain(per_cent, 3) + " %";
}

/// Says how far vertices moved, and how area and volume changed.
std::string movement(const FilterReport& report) {
    const std::string text =
        "\nVertices moved by up to " + plain(report.largest_displacement, 3) + ", RMS " +
        plain(report.rms_displacement, 3) +
        ".\nArea: " + relative_change(report.area_before, report.area_after - report.area_before) +
        ". ";
    if (std::isnan(report.volume_change))
        return text + "Volume: unknown, because the faces cannot be oriented alike.";
    if (std::isnan(report.volume_before))  // an open surface
        return text + "Volume swept along the normals: " + plain(report.volume_change, 3) + ".";
    return text + "Volume: " + relative_change(report.volume_before, report.volume_change) + ".";
}

/// Says what did not take part.
std::string bystanders(const FilterReport& report, std::int64_t held_vertices = 0) {
    std::string text;
    if (const std::int64_t joined = report.cracks.joined_vertices; joined > 0) {
        text += "\nCracks were closed: " + vertices(joined) + (joined == 1 ? " counts" : " count") +
                " as one with another that is nearer than 1e-6 of the diagonal.";
    }
    if (held_vertices > 0) text += "\n" + vertices(held_vertices) + " kept their positions.";
    if (report.degenerate_triangles > 0) {
        text += "\n" + faces(report.degenerate_triangles) + " with zero area had no influence.";
    }
    if (const std::int64_t copies = report.copied_triangles; copies > 0) {
        text += "\n" + faces(copies) + (copies == 1 ? " is a copy" : " are copies") +
                " of others, and did not count again.";
    }
    return text;
}

/// Returns the radius of a curvature. What is flat but for rounding has none.
std::string radius(double curvature, double area) {
    constexpr double flat = 1e-6;
    return curvature * std::sqrt(area) < flat ? "infinite" : plain(1 / curvature, 3);
}

/// Goes on after the height of noise.
std::string of_kind(NoiseKind kind) {
    switch (kind) {
        case NoiseKind::Varying:
            return ", and more in some places than in others";
        case NoiseKind::Shared:
            return ", shared by neighbouring vertices";
        case NoiseKind::Stairs:
            return ", in stairs";
        case NoiseKind::None:
        case NoiseKind::White:
        case NoiseKind::Outliers:
            break;
    }
    return {};
}

}  // namespace

std::string summary(const FlowParameters& parameters, const FlowReport& report) {
    std::string text = "Smoothed " + vertices(report.vertices) + " by " +
                       steps(static_cast<std::int64_t>(report.steps.size())) + " of " +
                       (parameters.flow == FlowKind::Conformalized ? "conformalized " : "") +
                       "mean-curvature flow in " + plain(report.seconds, 2) + " s.";
    if (!report.steps.empty() && report.stop == Stop::None) {
        text += report.has_strengths ? "\nWhere the strength is 1, detail" : "\nDetail";
        text += " smaller than " + plain(report.detail_size, 3) + " was removed.";
    }
    if (!report.steps.empty()) text += movement(report);
    if (report.unselected_triangles > 0) {
        const std::int64_t selected = report.triangles + report.zero_strength_triangles;
        text += "\nOnly the " + std::to_string(selected) + " selected of " +
                faces(selected + report.unselected_triangles) + " could move.";
    }
    if (report.zero_strength_triangles > 0) {
        text += "\n" + faces(report.zero_strength_triangles) +
                " stayed, because their vertices have strength 0.";
    }
    return text + bystanders(report, report.held_vertices);
}

std::string summary(const NoiseParameters& parameters, const NoiseReport& report) {
    const bool is_smooth = parameters.boundary == NoiseBoundary::Smooth &&
                           report.boundary_edges > 0 && report.largest_displacement > 0;
    const bool is_removed = report.kind != NoiseKind::None;
    std::string text = (is_removed                          ? "Removed noise from "
                        : is_smooth                         ? "Smoothed the rim of "
                        : report.stop == NoiseStop::NoNoise ? "Found no noise to remove from "
                                                            : "Removed no noise from ") +
                       vertices(report.vertices) + " in " + plain(report.seconds, 2) + " s.";
    if (is_removed && is_smooth) text += " The rim was smoothed, too.";
    if (is_removed) {
        if (report.cell_x > 0) {
            text += "\nStairs of cells with the sides " + plain(report.cell_x, 3) + ", " +
                    plain(report.cell_y, 3) + " and " + plain(report.cell_z, 3) + " were smoothed.";
        }
        if (report.noise > 0) {
            text += "\nThe noise along the normals was about " + plain(report.noise, 3) +
                    of_kind(report.kind) + ".";
        }
        if (report.outliers > 0) {
            text += "\n" + vertices(report.outliers) +
                    " had so much more than others that they hardly counted.";
        }
        if (report.crease_share > 0) {
            text += "\nCreases cross " + plain(100 * report.crease_share, 3) + " % of the area.";
        }
        if (report.detail_size > 0) {
            text += std::string(report.crease_share > 0 ? "\nElsewhere, detail" : "\nDetail") +
                    " smaller than " + plain(report.detail_size, 3) + " was removed.";
        }
    }
    if (report.largest_displacement > 0) text += movement(report);
    if (report.bounded_vertices > 0) {
        text += "\n" + vertices(report.bounded_vertices) +
                " moved as far as the largest movement allows.";
    }
    return text + bystanders(report, report.held_vertices);
}

std::string summary(const FairParameters& /*parameters*/, const FairReport& report) {
    if (report.patches == 0) return "Faired nothing." + bystanders(report);
    return "Faired " + vertices(report.vertices) + " of " +
           counted(report.patches, "patch", "patches") + " in " + plain(report.seconds, 2) +
           " s.\nMean radius of curvature: " + radius(report.patch_curvature, report.area_before) +
           " in the patches, " + radius(report.seam_curvature, report.area_before) +
           " around them.\nThe patches rise by up to " + plain(100 * report.height, 3) +
           " % of the size of their hole above its membrane." + movement(report) +
           bystanders(report);
}

std::string solver_details(const FlowParameters& parameters, const FlowReport& report) {
    PlainText text(3);
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
    return steps(report.smoothing_steps) + " with " + std::to_string(report.solver_iterations) +
           " iterations of the solvers, and " + steps(report.sharpening_steps) +
           " of the bilateral filter.\n";
}

std::string solver_details(const FairParameters& /*parameters*/, const FairReport& report) {
    return counted(report.passes, "solve", "solves") + " in a new metric.\n";
}

}  // namespace tracked_mcf
