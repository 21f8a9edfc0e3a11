#pragma once

#include <string>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Reads the vertices and triangles of an OFF file, for tests that must not need vcglib. Throws
/// std::runtime_error if it cannot.
TriangleMesh read_off(const std::string& path);

}  // namespace tracked_mcf
