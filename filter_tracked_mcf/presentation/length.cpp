// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/presentation/length.h"

#include <Eigen/Geometry>

namespace tracked_mcf {

double in_mesh_units(const Length& length, const TriangleMesh& mesh) {
    if (!length.in_per_cent) return length.value;
    Eigen::AlignedBox3d box;
    const auto count = static_cast<std::int64_t>(mesh.positions.size());
    for (const Triangle& triangle : mesh.triangles) {
        for (const std::int32_t vertex : triangle) {
            // The core refuses what is not a vertex, or not finite, with a message.
            if (vertex >= 0 && vertex < count && mesh.positions[vertex].allFinite())
                box.extend(mesh.positions[vertex]);
        }
    }
    return box.isEmpty() ? 0 : 0.01 * length.value * box.diagonal().norm();
}

}  // namespace tracked_mcf
