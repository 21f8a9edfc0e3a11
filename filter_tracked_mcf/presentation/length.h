// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// A length in units of the mesh, or in per cent of the diagonal of the bounding box of its faces.
struct Length {
    double value = 0;
    bool in_per_cent = false;
};

/// Returns the length in units of the mesh.
double in_mesh_units(const Length& length, const TriangleMesh& mesh);

}  // namespace tracked_mcf
