// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/parameters/noise_warnings.h"

#include <sstream>

namespace tracked_mcf {

std::string changes(const NoiseReport& report) {
    std::ostringstream text;
    text.precision(3);
    if (report.steps == 0) return "Nothing has moved.";
    text << "The noise along the normals is about " << report.noise << ". ";
    if (report.crease_share > 0) {
        text << "Creases were kept; they cross " << 100 * report.crease_share << " % of the area. ";
    }
    if (report.detail_size > 0) {
        text << "Elsewhere, waves of length " << report.detail_size
             << " keep half of their amplitude. ";
    }
    text << "The vertices moved by up to " << report.largest_displacement << ", RMS "
         << report.rms_displacement;
    if (report.bounded_vertices > 0)
        text << ", " << report.bounded_vertices << " of them as far as they may";
    text << "; the area changed by "
         << 100 * (report.area_after - report.area_before) / report.area_before << " %";
    if (report.oriented_consistently)
        text << ", the volume by " << report.volume_change << " cubic units";
    text << ".";
    return text.str();
}

std::vector<std::string> warnings_of(const NoiseParameters& /*parameters*/,
                                     const NoiseReport& report, const std::string& /*advice*/) {
    if (report.constrained_vertices == report.vertices) {
        return {
            "Nothing has moved: all of the surface is constrained. Free the boundary, or select "
            "more."};
    }
    if (report.steps == 0) {
        return {
            "Nothing has moved: the surface has no noise. To smooth it nevertheless, give a detail "
            "size."};
    }
    return {};
}

}  // namespace tracked_mcf
