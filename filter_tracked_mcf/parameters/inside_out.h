// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <string>
#include <vector>

namespace tracked_mcf {

/// Returns a warning for a user if the faces of a closed surface point inwards. `report` is that of
/// a filter which knows the enclosed volume.
template <class Report>
std::vector<std::string> inside_out(const Report& report) {
    // A flat surface encloses nothing but rounding. A ball encloses 0.094 of this power.
    if (report.volume_before >= -1e-6 * std::pow(report.area_before, 1.5)) return {};
    return {
        "The mesh is inside out: its faces point inwards. MeshLab's Invert Faces Orientation turns "
        "them."};
}

}  // namespace tracked_mcf
