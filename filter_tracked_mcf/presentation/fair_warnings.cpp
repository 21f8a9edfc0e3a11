// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/presentation/fair_warnings.h"

#include "filter_tracked_mcf/presentation/surface_warnings.h"

namespace tracked_mcf {

std::vector<std::string> warnings_of(const FairParameters& parameters, const FairReport& report) {
    std::vector<std::string> warnings = surface_warnings(report);
    const auto of_all = [&](std::int64_t count) {
        return std::to_string(count) + " of " + std::to_string(report.patches) +
               (report.patches == 1 ? " patch" : " patches");
    };
    if (report.patches == 0) {
        warnings.emplace_back(
            "Nothing has moved: the selected faces have no inner vertices. Close Holes leaves long "
            "triangles: refine the selected faces first, such as by Isotropic Explicit Remeshing.");
    }
    if (report.flatter_patches > 0) {
        warnings.push_back("The surface around " + of_all(report.flatter_patches) +
                           " does not tell the continuity that was asked for, so less was taken. "
                           "Remove noise first, and mend bad triangles, or look at the result.");
    }
    if (report.rough_patches > 0 && parameters.continuity != Continuity::Position) {
        warnings.push_back("The surface around " + of_all(report.rough_patches) +
                           " is rough for the size of the hole. Remove noise first, or take the "
                           "continuity of position.");
    }
    return warnings;
}

}  // namespace tracked_mcf
