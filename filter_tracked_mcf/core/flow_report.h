#pragma once

#include <cstdint>
#include <vector>

namespace tracked_mcf {

/// What one semi-implicit step did.
struct StepReport {
    double assemble_seconds = 0;  ///< metric, element matrices, Galerkin products, right side
    double solve_seconds = 0;     ///< W-cycles and the update of the coefficients
    /// 2-norm of the residual b - A d of the displacement's system, over the three coordinates, in
    /// grid units, before (d = 0, so the norm of b) and after the solve.
    double residual_before = 0;
    double residual_after = 0;
    int solver_iterations = 0;  ///< of conjugate gradients, or W-cycles
    /// Converged: what is left of the error at the end; see FlowParameters::tolerance.
    double relative_residual = 0;
    bool reached_tolerance = true;  ///< false if the solver stopped short of the tolerance
    double area = 0;  ///< of the tracked surface at the start of the step, mesh units²
    std::int64_t collapsed_samples = 0;  ///< left out because their area has collapsed
};

/// Why a flow ended before it had made all its steps.
enum class Stop {
    None,          ///< it did not
    Vanished,      ///< the next step would have left no area; its positions are not taken
    Pinched,       ///< so much has pinched that rescaling blows up the rest; likewise
    NothingMoves,  ///< every vertex is held, or every test function is locked or has pinched
};

/// What a whole flow did: sizes, seconds by phase, residuals.
struct FlowReport {
    std::int64_t vertices = 0;  ///< that triangles refer to
    std::int64_t triangles = 0;
    std::int64_t degenerate_triangles = 0;  ///< without area: they have no say in the flow
    std::int64_t boundary_edges = 0;
    std::int64_t held_vertices = 0;  ///< that triangles refer to: they keep their bits
    int depth = 0;
    double cell_size = 0;              ///< of the finest level, mesh units
    std::int64_t cells = 0;            ///< occupied cells of the finest level
    std::int64_t elements = 0;         ///< connected parts of the surface in them, if separated
    std::int64_t unknowns = 0;         ///< test functions of the finest level
    std::int64_t locked_unknowns = 0;  ///< of those, held by the boundary
    std::int64_t fragments = 0;        ///< triangles clipped to cells
    std::int64_t split_triangles = 0;  ///< fragments fanned into triangles
    std::int64_t samples = 0;          ///< cubature samples
    double area_before = 0;            ///< of the triangles that flow, mesh units²
    double area_after = 0;
    double setup_seconds = 0;
    std::vector<StepReport> steps;  ///< as many as were made
    Stop stop = Stop::None;
    std::int64_t estimated_memory_bytes = 0;  ///< expected for the flow before it was begun
    std::int64_t peak_memory_bytes = 0;  ///< of the whole process; 0 where the system does not say
};

}  // namespace tracked_mcf
