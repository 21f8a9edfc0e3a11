#pragma once

#include <string>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf::benchmark {

/// Radius of the spheres, which so fill the unit cube.
inline constexpr double kSphereRadius = 0.5;

/// A mesh by its name on the command line, as large as the unit cube:
///
///   sphere:N      geodesic sphere of frequency N, 10 N² + 2 vertices, about the origin
///   sphere:N:A    the same with noise: every radius is off by up to A mean edges' length, at
///   random tube:N        an open tube around which go N quads, as high as wide; about N² / 3
///   vertices FILE          scaled so that its longest side is 1 FILE:K        the same with every
///   triangle split into four, K times
///
/// Throws what MeshFile and std::stoi throw.
TriangleMesh named_mesh(const std::string& name);

/// Whether it is a sphere.
bool is_sphere(const std::string& name);

}  // namespace tracked_mcf::benchmark
