// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"
#include "tests/research/benchmark/cotangent_kernels.h"
#include "tests/research/benchmark/cotangent_pattern.h"

namespace tracked_mcf::benchmark {

/// Parameters of the flow and of its solver.
struct IncompleteCholeskyParameters {
    double step_size = 1e-5;  ///< δ, squared units of the mesh
    double tolerance = 1e-6;  ///< of the residual's 2-norm relative to the right-hand side's
    BoundaryCondition boundary = BoundaryCondition::Locked;  ///< constrained unless Free
    int threads = 1;                                         ///< also the number of blocks
    VertexOrder order = VertexOrder::ReverseCuthillMcKee;
    double relaxation = 0;  ///< 0 is IC(0); up to 1, modified IC(0)
    bool warm_start = true;
    int most_iterations = 10000;
};

/// Times and iterations of one step.
struct IncompleteCholeskyReport {
    double assemble_seconds = 0;
    double factorize_seconds = 0;
    double solve_seconds = 0;  ///< includes moving the vertices
    int iterations = 0;
    double relative_residual = 0;
};

/// The strongest peer that we know for small and medium steps: Dziuk's semi-implicit flow on the
/// mesh itself, as in tests/support/cotangent_flow.h. Conjugate gradients with an incomplete
/// Cholesky preconditioner solve (M + δS) d = -δ S x for all three coordinates together. README.md
/// describes the tuning. Coincident vertices are not merged.
class IncompleteCholeskyFlow {
public:
    IncompleteCholeskyFlow(const TriangleMesh& mesh,
                           const IncompleteCholeskyParameters& parameters);

    IncompleteCholeskyReport step();

    /// Returns the positions in the order of the initial mesh.
    std::vector<Eigen::Vector3d> positions() const;

    const CotangentPattern& pattern() const { return pattern_; }

    /// Returns the memory of matrix, factor, vectors and pattern.
    std::int64_t bytes() const;

private:
    /// Scalar products for each coordinate.
    struct Products {
        Doubles residual;  ///< r·r
        Doubles energy;    ///< r·z
    };

    void assemble();
    void factorize();
    void take_from_diagonal(float entry, std::int32_t row, std::int32_t column);
    void start();
    int iterate(Doubles& relative_residual, double goal);
    Products forward(const Floats& alpha);
    Doubles backward(const Floats& alpha, const Floats& beta);
    void multiply();
    Doubles add_couplings(const std::vector<Floats>& x);
    void move_vertices();
    Block block(std::size_t index);
    template <class Body>
    void for_each_block(const Body& body);

    IncompleteCholeskyParameters parameters_;
    const CotangentKernels& kernels_;
    CotangentPattern pattern_;
    double scale_ = 1;  ///< factor of the system that makes its numbers close to 1
    std::vector<Doubles> positions_, right_side_;
    std::vector<UpperEntry> upper_;  ///< all entries of the pattern
    std::vector<LowerEntry> lower_;
    std::vector<float> row_sums_, diagonal_, inverse_diagonal_;
    std::vector<Floats> x_, r_, z_, p_, q_;
    double right_side_norm_ = 0;
};

}  // namespace tracked_mcf::benchmark
