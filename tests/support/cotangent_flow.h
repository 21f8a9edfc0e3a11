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

/// The reference that the tracked flow is measured against: Dziuk's semi-implicit mean-curvature
/// flow with piecewise linear elements on the mesh itself (Numerische Mathematik 58, 1991). Each
/// step solves (M + δS) x(t+δ) = M x(t) with the full mass matrix M and the cotangent stiffness
/// matrix S of the present positions, in double precision by a sparse LDLᵀ factorisation.
///
/// Coincident vertices are one. Where the surface collapses, the flow is kept computable, no more:
/// a triangle of a quality under 1e-6 is as stiff as one of that quality, and a vertex keeps at
/// least 1e-4 of its initial mass.
class CotangentFlow {
public:
    /// step_size: as FlowParameters::step_size, for the model scaled to longest side 1.
    /// Unless the boundary is Free, its vertices are held, and nothing else: there are no cells
    /// here.
    CotangentFlow(const TriangleMesh& mesh, double step_size, BoundaryCondition boundary);

    /// Throws NumericalFailure if the matrix cannot be factorised.
    void step();

    /// The mesh with the present positions, its vertices numbered as at the start.
    const TriangleMesh& mesh() const { return mesh_; }

    /// Of the last step, ‖b - A d‖ / ‖b‖ over the three coordinates.
    double relative_residual() const { return relative_residual_; }

    /// Smallest quality of a triangle at present.
    double smallest_quality() const { return smallest_quality_; }

    /// Of every triangle: whether, after some step, its quality was under 0.01 or its area under
    /// 0.01 of what it was at the start. What this flow says there, and later, is doubtful.
    const std::vector<std::uint8_t>& degenerated() const { return degenerated_; }

private:
    using Matrix = Eigen::SparseMatrix<double>;
    using Points = Eigen::Matrix<double, Eigen::Dynamic, 3>;

    void assemble();
    std::vector<double> masses() const;  ///< lumped, of every vertex; 0 if welded away
    Points solve();
    void look_for_degenerated();

    TriangleMesh mesh_;
    std::vector<std::int32_t> welded_;
    std::vector<std::uint8_t> held_;      ///< of every vertex
    std::vector<double> initial_areas_;   ///< of every triangle
    std::vector<double> initial_masses_;  ///< of every vertex, lumped
    double step_size_;                    ///< δ, squared mesh units

    Matrix matrix_;      ///< M + δS
    Points right_side_;  ///< -δ S x
    Eigen::SimplicialLDLT<Matrix> solver_;
    bool is_analyzed_ = false;

    double relative_residual_ = 0;
    double smallest_quality_ = 0;
    std::vector<std::uint8_t> degenerated_;
};

}  // namespace tracked_mcf
