// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/change.h"

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

ChangeReport change_of(const TriangleMesh& before, const std::vector<Eigen::Vector3d>& after,
                       const std::vector<std::uint8_t>& counted, const Selection& selection,
                       bool encloses_volume) {
    ChangeReport change;
    double largest = 0, squares = 0, count = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        if (counted[i] == 0) continue;
        const double square = (after[i] - before.positions[i]).squaredNorm();
        squares += square;
        largest = std::max(largest, square);
        ++count;
    }
    change.largest_displacement = std::sqrt(largest);
    if (count > 0) change.rms_displacement = std::sqrt(squares / count);
    change.area_before = surface_area(before, selection);
    change.area_after = surface_area({after, before.triangles}, selection);
    if (encloses_volume) change.volume_before = enclosed_volume(before);
    change.volume_change =
        parallel_sum(static_cast<std::int64_t>(before.triangles.size()), 0.0,
                     [&](std::int64_t begin, std::int64_t end) {
                         double sum = 0;
                         for (std::int64_t i = begin; i < end; ++i) {
                             if (!selection.empty() && selection[i] == 0) continue;
                             const Triangle& triangle = before.triangles[i];
                             sum += swept_volume(corners_of(before.positions, triangle),
                                                 corners_of(after, triangle));
                         }
                         return sum;
                     });
    return change;
}

}  // namespace tracked_mcf
