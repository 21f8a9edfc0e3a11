// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/presentation/noise_warnings.h"

#include <cmath>

#include "filter_tracked_mcf/core/plain_text.h"
#include "filter_tracked_mcf/presentation/surface_warnings.h"

namespace tracked_mcf {

namespace {

std::string rounded(double number) {
    return plain(number, 2);
}

std::string per_cent(double share) {
    return share < 0.1 ? rounded(100 * share) : std::to_string(std::lround(100 * share));
}

/// Begins a sentence that says why no noise was removed. A rim may have moved.
std::string nothing(const NoiseReport& report) {
    return report.largest_displacement > 0 ? "No noise was removed: " : "Nothing has moved: ";
}

/// Returns whether a lattice of voxels or slices was found.
bool has_cells(const NoiseReport& report) {
    return report.cell_x > 0;
}

/// Says what there may be instead of noise.
std::string no_noise(const NoiseParameters& parameters, const NoiseReport& report) {
    if (has_cells(report)) return {};  // see stairs_text()
    const std::string text = nothing(report);
    if (parameters.noise > 0) {
        return text + "any smoothing moves vertices farther than noise of " +
               rounded(parameters.noise) + ". If there is more, give more.";
    }
    if (report.stairs > 0) {
        return text + "there is no noise from vertex to vertex, but stairs " +
               rounded(report.stairs) +
               " high, perhaps of heights in whole numbers. If they are noise, give one "
               "and a half times their height as the size of the noise.";
    }
    return text +
           "there is no noise that can be told from detail. If the lumps or waves that you see are "
           "noise, switch on Lumps, too.";
}

/// Says that noise was removed that may be detail.
std::string shared_text(const NoiseParameters& parameters, const NoiseReport& report) {
    if (report.kind != NoiseKind::Shared) return {};
    const std::string size =
        rounded(report.noise_size) + " wide and " + rounded(report.noise) + " high";
    if (parameters.lumps) return "Lumps and waves about " + size + " were taken for noise.";
    return "Neighbouring vertices have much the same noise, about " + size +
           ", everywhere. It was removed. If it is detail, as of cloth, give the mean length of an "
           "edge as the size of the noise.";
}

/// Says which stairs were smoothed, or stay, since they may be a part of the shape.
std::string stairs_text(const NoiseReport& report) {
    const std::string height = rounded(report.stairs);
    if (has_cells(report) && report.kind != NoiseKind::Stairs) {
        return "Stairs " + height +
               " high, as of voxels or slices, stay: they may be the shape. If they are not, give "
               "their height as the size of the noise.";
    }
    if (report.kind != NoiseKind::Stairs) return {};
    if (has_cells(report)) {
        return "Stairs " + height +
               " high, as of voxels or slices, were smoothed. No vertex has moved by more than "
               "half "
               "a voxel along any of its sides. If they are the shape, give a size of the noise of "
               "less than half their height.";
    }
    return "The mesh consists of stairs " + height +
           " high, as of heights in whole numbers. They were smoothed as noise that is " +
           rounded(report.noise_size) +
           " wide. If they are the shape, give a smaller size of the noise.";
}

/// Empty unless the size of the noise that the user gives is too small for what the mesh has. Then
/// smoothing takes less than a quarter of the noise, RMS, else more than half.
std::string too_small(const NoiseParameters& parameters, const NoiseReport& report) {
    constexpr double least = 0.4, rounding = 1e-9;
    if (report.stop != NoiseStop::None || parameters.noise_size == 0 ||
        report.noise_size > (1 + rounding) * parameters.noise_size ||
        report.rms_displacement >= least * report.noise) {
        return {};
    }
    return "Hardly any noise of the size " + rounded(parameters.noise_size) +
           " was removed. If there is noise, it is wider: give a larger size of the noise.";
}

std::string stop_text(const NoiseParameters& parameters, const NoiseReport& report) {
    switch (report.stop) {
        case NoiseStop::None:
        case NoiseStop::TooMuchLost:  // see loss()
            return {};
        case NoiseStop::NothingMoves:
            return nothing(report) +
                   "all of the surface is held. Free the boundary, or select more.";
        case NoiseStop::TooFewVertices:
            return nothing(report) +
                   "fewer than 100 vertices can move, too few to measure noise. Give the noise, a "
                   "detail size or a smaller size of the noise, or refine the mesh.";
        case NoiseStop::TooManyCreases:
            return nothing(report) + "creases cross " + per_cent(report.crease_share) +
                   " % of the area, so noise cannot be told from the shape. Give a crease angle of "
                   "more than " +
                   rounded(report.median_turn) +
                   "°, by which half of the area turns, or the noise, or a detail size.";
        case NoiseStop::ModelledPart:
            return nothing(report) + per_cent(report.flat_edges) +
                   " % of the edges are exactly flat, as of modelled parts and of depths in steps; "
                   "noise leaves none. If there is noise, give its standard deviation or its size, "
                   "or switch on Lumps, too.";
        case NoiseStop::NoNoise:
            return no_noise(parameters, report);
    }
    return {};
}

/// Empty unless steps were shorter than the detail size that the user gives needs.
std::string shorter(const NoiseParameters& parameters, const NoiseReport& report) {
    constexpr double least = 0.99;  // rounding
    if (report.detail_size == 0 || report.detail_size >= least * parameters.detail_size) return {};
    return "Only detail smaller than " + rounded(report.detail_size) +
           " was removed: larger steps would take vertices away or lose their places. The flow "
           "removes larger detail.";
}

/// Empty unless a part of the surface loses more than noise.
std::string loss(const NoiseReport& report) {
    if (report.shrunken_parts == 0) return {};
    const bool one = report.shrunken_parts == 1;
    const std::string parts = one ? "A part of the surface"
                                  : std::to_string(report.shrunken_parts) + " parts of the surface";
    const std::string most = one ? "" : "up to ", whose = one ? "its " : "their ";
    const std::string losses = most + per_cent(report.lost_area) + " % of " + whose + "area, " +
                               most + per_cent(report.lost_volume) + " % of change in " + whose +
                               "volume, " + std::to_string(report.turned_triangles) +
                               " faces turned over";
    if (report.kept_parts > 0) {
        return parts + (one ? " stays as it was" : " stay as they were") +
               ". Smoothing would have cost more than noise: " + losses +
               ". If it is noise nevertheless, give its standard deviation or its size.";
    }
    return parts + (one ? " has" : " have") + " lost more than noise: " + losses +
           ". Look at the result; a smaller detail size or a largest movement limits it.";
}

}  // namespace

std::vector<std::string> warnings_of(const NoiseParameters& parameters, const NoiseReport& report) {
    std::vector<std::string> warnings = surface_warnings(report);
    for (const std::string& warning :
         {stop_text(parameters, report), stairs_text(report), shared_text(parameters, report),
          too_small(parameters, report), shorter(parameters, report), loss(report)}) {
        if (!warning.empty()) warnings.push_back(warning);
    }
    return warnings;
}

}  // namespace tracked_mcf
