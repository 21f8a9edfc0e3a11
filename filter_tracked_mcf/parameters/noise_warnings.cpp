// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/parameters/noise_warnings.h"

#include "filter_tracked_mcf/parameters/inside_out.h"

namespace tracked_mcf {

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
    return inside_out(report);
}

}  // namespace tracked_mcf
