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
    /// A vector per vertex. The fourth component is 0, and makes arithmetic four wide.
    using Normals = std::vector<Eigen::Vector4f>;

    /// Where lengths vary, `densities` has 1 / r² for each triangle if its δ and s² are r² times
    /// those that smooth() gets; else it is empty.
    NormalSmoother(const MeshTopology& topology, std::vector<double> densities);

    /// Smooths the normals of the surface with these positions, one per vertex of the mesh; δ is
    /// `step_size`, a squared length, and s is `normal_length`, in the unit of the positions.
    /// Returns a unit vector per vertex, or zero if no triangle of MeshTopology::triangles has it
    /// or all of these are flat. Valid until the next call. The bits are the same for any number of
    /// threads.
    const Normals& smooth(const std::vector<Eigen::Vector3d>& positions, double step_size,
                          double normal_length);

    /// Estimates the noise of the surface with these positions: the standard deviation of
    /// independent displacements of the vertices along their normals, in the unit of the positions.
    /// Where lengths vary, it is that where the density is 1. Sharp edges and smooth curvature
    /// count little, detail as fine as the triangles counts as noise.
    ///
    /// Two differences of a vertex from the mean of its neighbours leave noise and little else; the
    /// median is that of most vertices (Immerkær, "Fast Noise Variance Estimation", 1996, and
    /// Donoho and Johnstone, "Ideal Spatial Adaptation by Wavelet Shrinkage", 1994, for images).
    double noise(const std::vector<Eigen::Vector3d>& positions);

    /// Returns the surface's triangles.
    const RawVector<Triangle>& triangles() const { return triangles_; }
    /// Returns the density of a triangle.
    double density(std::int64_t triangle) const {
        return densities_.empty() ? 1 : densities_[triangle];
    }

private:
    void orient(const MeshTopology& topology);
    void find_stars(std::size_t vertex_count);
    void find_rows();
    void average_normals(const std::vector<Eigen::Vector3d>& positions);
    double vertex_density(std::int32_t vertex) const;
    void assemble(const std::vector<Eigen::Vector3d>& positions, double step_size,
                  double normal_length);
    void solve();
    Eigen::Vector4f product(const Normals& x, std::int32_t vertex) const;  // of M + δ L

    RawVector<Triangle> triangles_;
    std::vector<double> densities_;
    std::vector<std::uint8_t> flipped_;     ///< per triangle
    std::vector<std::int64_t> star_begin_;  ///< per vertex, and the end
    RawVector<std::uint32_t> stars_;        ///< 3 × triangle + corner, sorted
    std::vector<std::size_t> row_begin_;    ///< per vertex, and the end
    std::vector<std::int32_t> columns_;     ///< of each row: the vertices of the star, sorted
    /// Per entry of stars_: where the row has each corner of the triangle.
    RawVector<std::array<std::uint32_t, 3>> slots_;

    // Workspaces.
    RawVector<std::array<float, 4>> weights_;  ///< per triangle: δ cot / 2 at each corner, mass
    RawVector<float> values_;                  ///< of M + δ L, one for each column
    RawVector<float> masses_, inverse_;  ///< per vertex: of M, and of the diagonal's inverse or 0
    Normals averages_, normals_, residual_, direction_, product_;
};

}  // namespace tracked_mcf
