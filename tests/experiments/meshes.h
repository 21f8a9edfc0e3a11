// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf::experiments {

/// Returns the mesh of a name on the command line: "sphere:N" is the unit sphere of geodesic
/// frequency N; any other name is a file.
TriangleMesh named_mesh(const std::string& name);

}  // namespace tracked_mcf::experiments
