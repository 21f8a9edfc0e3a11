// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// 4√3 area / Σ edge²: 1 for an equilateral triangle, 0 for a degenerate one.
double triangle_quality(const TriangleMesh& mesh, const Triangle& triangle);

/// The reference flow: Dziuk's semi-implicit mean-curvature flow with piecewise linear elements on
/// the mesh itself (Numerische Mathematik 58, 1991). Each step solves (M + δS) x(t+δ) = M x(t) with
/// the full mass matrix M and the cotangent stiffness matrix S of the present positions, in double
/// precision by a sparse LDLᵀ factorisation.
///
/// Coincident vertices count as one. Two limits keep the flow computable where the surface
/// collapses: a triangle of quality below 1e-6 is as stiff as one of quality 1e-6, and a vertex
/// keeps at least 1e-4 of its initial mass.
class CotangentFlow {
public:
    /// step_size: as FlowParameters::step_size, for the model scaled to longest side 1. Unless the
    /// boundary is Free, its vertices are constrained. LockedCells is treated as Locked.
    CotangentFlow(const TriangleMesh& mesh, double step_size, BoundaryCondition boundary);

    /// Throws std::runtime_error if the matrix cannot be factorised.
    void step();

    /// Returns the mesh with the current positions and the initial numbering of vertices.
    const TriangleMesh& mesh() const { return mesh_; }

    /// Returns ‖b - A d‖ / ‖b‖ of the last step, over the three coordinates.
    double relative_residual() const { return relative_residual_; }

    /// Returns the smallest quality of a triangle now.
    double smallest_quality() const { return smallest_quality_; }

    /// Returns, per triangle, whether its quality fell below 0.01, or its area below 0.01 of its
    /// initial area, after any step. The flow is not a reliable reference there from then on.
    const std::vector<std::uint8_t>& degenerated() const { return degenerated_; }

private:
    using Matrix = Eigen::SparseMatrix<double>;
    using Points = Eigen::Matrix<double, Eigen::Dynamic, 3>;

    void assemble();
    std::vector<double> masses() const;  ///< lumped, per vertex; 0 if welded to another
    Points solve();
    void look_for_degenerated();

    TriangleMesh mesh_;
    std::vector<std::int32_t> welded_;
    std::vector<std::uint8_t> constrained_;  ///< per vertex
    std::vector<double> initial_areas_;      ///< per triangle
    std::vector<double> initial_masses_;     ///< lumped, per vertex
    double step_size_;                       ///< δ, squared mesh units

    Matrix matrix_;      ///< M + δS
    Points right_side_;  ///< -δ S x
    Eigen::SimplicialLDLT<Matrix> solver_;
    bool is_analyzed_ = false;

    double relative_residual_ = 0;
    double smallest_quality_ = 0;
    std::vector<std::uint8_t> degenerated_;
};

}  // namespace tracked_mcf
