// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/crack_report.h"

namespace tracked_mcf {

/// Returns a warning for a user if a surface has cracks that are too wide to be joined.
inline std::vector<std::string> open_cracks(const CrackReport& cracks) {
    if (cracks.open_pairs == 0) return {};
    std::ostringstream text;
    text.precision(2);
    text << cracks.open_pairs << (cracks.open_pairs == 1 ? " pair" : " pairs")
         << " of rim vertices " << (cracks.open_pairs == 1 ? "is " : "are up to ")
         << cracks.open_width
         << " apart, so the surface may open there. If it is a crack, merge close vertices first.";
    return {text.str()};
}

}  // namespace tracked_mcf
