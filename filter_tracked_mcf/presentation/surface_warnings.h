// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "filter_tracked_mcf/core/crack_report.h"

namespace tracked_mcf {

/// Returns a warning for a user if a surface has cracks that are too wide to be closed, else
/// nothing.
std::vector<std::string> open_cracks(const CrackReport& cracks);

/// Returns a warning for a user if the faces of a closed surface point inwards, else nothing. The
/// volume is 0 if it is not known.
std::vector<std::string> inside_out(double volume, double area);

/// Returns both for a filter that knows the volume.
template <class Report>
std::vector<std::string> surface_warnings(const Report& report) {
    std::vector<std::string> warnings = open_cracks(report.cracks);
    for (std::string& text : inside_out(report.volume_before, report.area_before)) {
        warnings.push_back(std::move(text));
    }
    return warnings;
}

}  // namespace tracked_mcf
