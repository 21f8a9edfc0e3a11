// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Reads an OFF file of triangles. Throws std::runtime_error if it cannot.
TriangleMesh read_off(const std::string& path);

}  // namespace tracked_mcf
