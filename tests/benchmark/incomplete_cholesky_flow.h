#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"
#include "tests/benchmark/cotangent_kernels.h"
#include "tests/benchmark/cotangent_pattern.h"

namespace tracked_mcf::benchmark {

/// How the flow's systems are solved.
struct IncompleteCholeskyParameters {
    double step_size = 1e-5;  ///< δ, squared units of the mesh
    double tolerance = 1e-6;  ///< of the residual's 2-norm, relative to the right side's
    BoundaryCondition boundary = BoundaryCondition::Locked;  ///< vertices are held unless Free
    int threads = 1;                                         ///< and blocks of the factorisation
    VertexOrder order = VertexOrder::ReverseCuthillMcKee;
    double relaxation = 0;  ///< 0 is IC(0); up to 1, modified IC(0)
    bool warm_start = true;
    int most_iterations = 10000;
};

/// What one step did.
struct IncompleteCholeskyReport {
    double assemble_seconds = 0;
    double factorize_seconds = 0;
    double solve_seconds = 0;  ///< and the moving of the vertices
    int iterations = 0;
    double relative_residual = 0;
};

/// The strongest peer that we know for steps that are not large: Dziuk's semi-implicit flow on the
/// mesh itself, as tests/support/cotangent_flow.h has it, with each step's (M + δS) d = -δ S x
/// solved by conjugate gradients, preconditioned by an incomplete Cholesky factorisation, for all
/// three coordinates at once. README.md says how it is tuned. Coincident vertices are not joined.
class IncompleteCholeskyFlow {
public:
    IncompleteCholeskyFlow(const TriangleMesh& mesh,
                           const IncompleteCholeskyParameters& parameters);

    IncompleteCholeskyReport step();

    /// Positions, in the order of the mesh that the flow was made from.
    std::vector<Eigen::Vector3d> positions() const;

    const CotangentPattern& pattern() const { return pattern_; }

    /// Of matrix, factor, vectors and pattern.
    std::int64_t bytes() const;

private:
    /// Of each coordinate.
    struct Products {
        Doubles residual;  ///< r·r
        Doubles energy;    ///< r·z
    };

    void assemble();
    void factorize();
    void take_from_diagonal(float entry, std::int32_t row, std::int32_t column);
    void start();
    int iterate(Doubles& final_residual, double goal);
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
    double scale_ = 1;  ///< of the system, so that numbers are near 1
    std::vector<Doubles> positions_, right_side_;
    std::vector<UpperEntry> upper_;  ///< all entries of the pattern
    std::vector<LowerEntry> lower_;
    std::vector<float> row_sums_, diagonal_, inverse_diagonal_;
    std::vector<Floats> x_, r_, z_, p_, q_;
    double right_side_norm_ = 0;
};

}  // namespace tracked_mcf::benchmark
