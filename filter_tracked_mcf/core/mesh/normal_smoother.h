// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/mesh/mesh_topology.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"

namespace tracked_mcf {

/// Smooths the normals of a surface's vertices, and keeps edges: where normals turn quickly, the
/// surface counts as long.
///
/// The smooth normals N solve (M + δ L) N = M N₀, normalised, where N₀ are the mean normals of the
/// vertices' triangles, weighted by area. M and L are the mass and the stiffness of linear elements
/// in the metric of (X, s N), so this is a step of equation 2 for the normals. It is solved a few
/// times, each with the N of the time before; the first metric is that of X.
///
/// Coincident vertices are one. Neighbouring triangles are oriented alike first, so the orientation
/// of the mesh does not matter. A surface with one side gets a seam that counts as an edge.
class NormalSmoother {
public:
    /// Where lengths vary, `densities` has 1 / r² for each triangle if its δ and s² are r² times
    /// those that smooth() gets; else it is empty.
    NormalSmoother(const MeshTopology& topology, std::vector<double> densities);

    /// Smooths the normals of the surface with these positions, one per vertex of the mesh; δ is
    /// `step_size`, a squared length, and s is `normal_length`, in the unit of the positions.
    /// Returns a unit vector per vertex, only those of MeshTopology::triangles are set. Valid until
    /// the next call. The bits are the same for any number of threads.
    const std::vector<Eigen::Vector3f>& smooth(const std::vector<Eigen::Vector3d>& positions,
                                               double step_size, double normal_length);

    /// Returns the surface's triangles.
    const RawVector<Triangle>& triangles() const { return triangles_; }
    /// Returns the density of a triangle.
    double density(std::int64_t triangle) const {
        return densities_.empty() ? 1 : densities_[triangle];
    }

private:
    using Field = std::vector<Eigen::Vector3f>;  ///< a vector per vertex

    void orient(const MeshTopology& topology);
    void find_stars(std::size_t vertex_count);
    void average_normals(const std::vector<Eigen::Vector3d>& positions);
    void assemble(const std::vector<Eigen::Vector3d>& positions, double step_size,
                  double normal_length);
    void solve();
    Eigen::Vector3f product(const Field& x, std::int32_t vertex) const;  // of M + δ L
    /// Calls visit(triangle, corner) for all triangles of a vertex.
    template <class Visit>
    void for_each_corner(std::int32_t vertex, const Visit& visit) const;

    RawVector<Triangle> triangles_;
    std::vector<double> densities_;
    std::vector<std::uint8_t> flipped_;     ///< per triangle
    std::vector<std::int64_t> star_begin_;  ///< per vertex, and the end
    RawVector<std::uint32_t> stars_;        ///< 3 × triangle + corner, sorted

    // Workspaces.
    std::vector<std::array<float, 4>> weights_;  ///< per triangle: δ cot / 2 at each corner, mass
    std::vector<float> masses_, diagonal_;       ///< per vertex
    Field averages_, normals_, residual_, direction_, product_;
};

}  // namespace tracked_mcf
