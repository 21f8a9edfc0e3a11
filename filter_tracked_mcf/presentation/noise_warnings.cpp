// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/presentation/noise_warnings.h"

#include <cmath>
#include <sstream>

#include "filter_tracked_mcf/presentation/surface_warnings.h"

namespace tracked_mcf {

namespace {

std::string rounded(double number) {
    std::ostringstream text;
    text.precision(2);
    text << number;
    return text.str();
}

std::string per_cent(double share) {
    return share < 0.1 ? rounded(100 * share) : std::to_string(std::lround(100 * share));
}

/// Begins a sentence that says why no noise was removed. A rim may have moved.
std::string nothing(const NoiseReport& report) {
    return report.largest_displacement > 0 ? "No noise was removed: " : "Nothing has moved: ";
}

/// Says what there may be instead of noise from vertex to vertex.
std::string no_noise(const NoiseReport& report) {
    const std::string text = nothing(report) + "there is no noise from vertex to vertex";
    if (report.stairs > 0) {
        return text + ", but stairs " + rounded(report.stairs) +
               " high, perhaps of slices, voxels or whole numbers. If they are noise, give one "
               "and a half times their height as the size of the noise.";
    }
    if (report.lump_width > 0) {
        return text + ", but perhaps in lumps or waves, about " + rounded(report.lump_width) +
               " wide and " + rounded(report.lump_height) +
               " high. If that is not detail, give its width as the size of the noise.";
    }
    return text +
           ". Noise in lumps or waves cannot be told from detail. If there is some, give the size "
           "of the noise: half the width of lumps, or half the length of waves.";
}

/// Says that stairs were smoothed, which may be a part of the shape.
std::string stairs_text(const NoiseReport& report) {
    if (report.stop != NoiseStop::None || report.stairs == 0) return {};
    return "The mesh consists of stairs " + rounded(report.stairs) +
           " high, as of voxels, slices or whole numbers. They were smoothed as noise that is " +
           rounded(report.noise_size) +
           " wide. If they are the shape, give a smaller size of the noise.";
}

/// Empty unless the size of the noise that the user gives is too small for what the mesh has. Then
/// smoothing takes less than a quarter of the noise, RMS, else more than half.
std::string too_small(const NoiseParameters& parameters, const NoiseReport& report) {
    constexpr double least = 0.4;
    if (report.stop != NoiseStop::None || parameters.noise_size == 0 ||
        report.noise_size > parameters.noise_size ||
        report.rms_displacement >= least * report.noise) {
        return {};
    }
    return "Hardly any noise of the size " + rounded(parameters.noise_size) +
           " was removed. If there is noise, it is wider: give a larger size of the noise.";
}

std::string stop_text(const NoiseReport& report) {
    switch (report.stop) {
        case NoiseStop::None:
            return {};
        case NoiseStop::NothingMoves:
            return nothing(report) +
                   "all of the surface is constrained. Free the boundary, or select more.";
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
        case NoiseStop::NoNoise:
            return no_noise(report);
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

/// Empty unless a part of the surface has lost more than noise.
std::string loss(const NoiseReport& report) {
    if (report.shrunken_parts == 0) return {};
    const bool one = report.shrunken_parts == 1;
    return (one ? "A part of the surface has lost"
                : std::to_string(report.shrunken_parts) + " parts of the surface have lost up to") +
           " " + per_cent(report.lost_area) + " % of the area without noise, and the volume " +
           (one ? "has changed by " : "of a part has changed by up to ") +
           per_cent(report.lost_volume) +
           " %. Look at the result; a smaller detail size or a largest movement limits it.";
}

}  // namespace

std::vector<std::string> warnings_of(const NoiseParameters& parameters, const NoiseReport& report) {
    std::vector<std::string> warnings = surface_warnings(report);
    for (const std::string& warning :
         {stop_text(report), stairs_text(report), too_small(parameters, report),
          shorter(parameters, report), loss(report)}) {
        if (!warning.empty()) warnings.push_back(warning);
    }
    return warnings;
}

}  // namespace tracked_mcf
