// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/change_report.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Returns how the selected triangles of a mesh have changed, once its vertices are at `after`.
/// `counted` are flags of one copy of each vertex that counts. `encloses_volume` is
/// Domain::encloses_volume().
ChangeReport change_of(const TriangleMesh& before, const std::vector<Eigen::Vector3d>& after,
                       const std::vector<std::uint8_t>& counted, const Selection& selection,
                       bool encloses_volume);

}  // namespace tracked_mcf
