// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf::benchmark {

/// Radius of the spheres. They fill the unit cube.
inline constexpr double kSphereRadius = 0.5;

/// Returns the mesh of a name on the command line, scaled to the unit cube:
///
///   sphere:N      geodesic sphere about the origin, of frequency N, with 10 N² + 2 vertices
///   sphere:N:A    the same with random noise of up to A mean edge lengths in the radius
///   FILE          a file, scaled to a longest side of 1
///   FILE:K        the same with each triangle split into four, K times
///
/// Throws the exceptions of MeshFile and std::stoi.
TriangleMesh named_mesh(const std::string& name);

/// Returns whether the name is a sphere's.
bool is_sphere(const std::string& name);

}  // namespace tracked_mcf::benchmark
