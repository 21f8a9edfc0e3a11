// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <functional>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf::shapes {

/// Unit sphere: the faces of an icosahedron, each split into frequency² triangles, projected.
/// 10 frequency² + 2 vertices.
TriangleMesh geodesic_sphere(int frequency);

/// The unit square [0, 1]² in the plane z = 0, n by n quads of two triangles each.
TriangleMesh square(int n);

/// The surface of the box [0, sizes], each face of n by n quads of two triangles; welded.
TriangleMesh box(int n, const Eigen::Vector3d& sizes);

/// A torus around the z axis with these radii, n by m quads of two triangles.
TriangleMesh torus(int n, int m, double radius, double tube_radius);

/// The cylinder of radius 1 around the z axis between z = ± height / 2, without its ends, n by m
/// quads of two triangles.
TriangleMesh tube(int n, int m, double height);

/// The ring between these radii in the plane z = 0, n by m quads of two triangles.
TriangleMesh annulus(int n, int m, double inner_radius, double outer_radius);

/// A Möbius band around the z axis, of radius 1 and width 0.8, n by m quads of two triangles each.
TriangleMesh moebius_band(int n, int m);

/// A sphere with bumps and no symmetry: a stand-in for a scan.
TriangleMesh bumpy_sphere(int frequency);

/// Moves every vertex by a transformation.
TriangleMesh transformed(TriangleMesh mesh, const Eigen::Affine3d& transformation);

/// Joins two meshes into one.
TriangleMesh merged(TriangleMesh first, const TriangleMesh& second);

/// Turns every triangle over.
TriangleMesh inside_out(TriangleMesh mesh);

/// Gives every triangle three vertices of its own.
TriangleMesh soup(const TriangleMesh& mesh);

/// A fan of long thin triangles around the origin, with a wavy rim near the unit circle.
TriangleMesh fan(int triangles);

/// Copies of a sheet at this distance from each other along z. They coincide if it is 0.
TriangleMesh stack(const TriangleMesh& sheet, int count, double distance);

/// Splits every triangle into four at the middles of its sides. New vertices follow the old ones.
TriangleMesh split_in_four(const TriangleMesh& mesh);

/// Small unconnected triangles at random positions in the unit cube.
TriangleMesh separate_triangles(int count);

/// The faces between solid and empty cells of side 1, among the cells whose lower corners have
/// coordinates from `begin` to `end` - 1. All other cells are empty. Vertices are welded.
TriangleMesh voxels(int begin, int end,
                    const std::function<bool(const Eigen::Vector3i&)>& is_solid);

/// The surface that marching cubes finds where a field passes 1/2, given its values at the middles
/// of cells, with coordinates from `begin` to `end` - 1. All other values are 0. Vertices are
/// welded.
TriangleMesh marching_cubes(int begin, int end,
                            const std::function<double(const Eigen::Vector3i&)>& field);

/// Returns the volume inside a closed mesh: the sum of the signed volumes of the tetrahedra between
/// its triangles and the origin.
double volume(const TriangleMesh& mesh);

/// Returns the centre of mass of the surface. The surface must have an area.
Eigen::Vector3d surface_centroid(const TriangleMesh& mesh);

}  // namespace tracked_mcf::shapes
