// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/parameters/length.h"

#include <Eigen/Geometry>

namespace tracked_mcf {

double in_mesh_units(const Length& length, const TriangleMesh& mesh) {
    if (!length.in_per_cent) return length.value;
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& position : mesh.positions) box.extend(position);
    return mesh.positions.empty() ? 0 : 0.01 * length.value * box.diagonal().norm();
}

}  // namespace tracked_mcf
