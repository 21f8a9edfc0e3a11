// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/presentation/surface_warnings.h"

#include <cmath>

#include "filter_tracked_mcf/core/plain_text.h"

namespace tracked_mcf {

namespace {

/// Empty if no crack is open.
std::string open_cracks(const CrackReport& cracks) {
    if (cracks.open_pairs == 0) return {};
    const bool one = cracks.open_pairs == 1;
    PlainText text(2);
    text << cracks.open_pairs
         << (one ? " pair of rim vertices is " : " pairs of rim vertices are up to ")
         << cracks.open_width
         << " apart, so the surface may open there. If it is a crack, merge close vertices first.";
    return text.str();
}

/// Empty unless a volume is enclosed, and negative.
std::string inside_out(double volume, double area) {
    // A flat surface encloses nothing but rounding. A ball encloses 0.094 of this power.
    if (!(volume < -1e-6 * std::pow(area, 1.5))) return {};
    return "The mesh is inside out: its faces point inwards. MeshLab's Invert Faces Orientation "
           "turns them.";
}

/// Empty if no part is double-sided.
std::string double_sided(std::int64_t parts) {
    if (parts == 0) return {};
    return (parts == 1 ? "A part of the surface is"
                       : std::to_string(parts) + " parts of the surface are") +
           " double-sided: most faces there have a copy that looks the other way. A face and its "
           "copies count as one, and move together.";
}

}  // namespace

std::vector<std::string> surface_warnings(const FilterReport& report) {
    std::vector<std::string> warnings;
    for (const std::string& text :
         {open_cracks(report.cracks), double_sided(report.double_sided_parts),
          inside_out(report.volume_before, report.area_before)}) {
        if (!text.empty()) warnings.push_back(text);
    }
    return warnings;
}

}  // namespace tracked_mcf
