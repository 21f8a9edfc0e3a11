#pragma once

#include <string>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf::experiments {

/// A mesh by its name on the command line: "sphere:N", the unit sphere of geodesic frequency N, or
/// a file that the program can read.
TriangleMesh named_mesh(const std::string& name);

}  // namespace tracked_mcf::experiments
