#pragma once

#include <Eigen/Core>
#include <vector>

#include "filter_tracked_mcf/core/element_matrices.h"
#include "filter_tracked_mcf/core/locked_cells.h"
#include "filter_tracked_mcf/core/multigrid.h"
#include "filter_tracked_mcf/core/stabilization.h"
#include "filter_tracked_mcf/core/tracked_elements.h"

namespace tracked_mcf {

/// How a System is set up.
struct SystemOptions {
    bool lock = false;         ///< the cells of the boundary
    double stabilization = 0;  ///< weight
    CycleParameters cycle = {};
};

/// A flow's system on some mesh, at the first step.
struct System {
    System(const TriangleMesh& mesh, int depth, float step, const SystemOptions& options = {})
        : elements(
              build_tracked_elements(mesh, enclosing_grid(mesh, depth), Cubature::ThreePoints)),
          frozen(options.lock ? unknowns_meeting_held_edges(elements) : no_unknowns(elements)),
          multigrid(elements, frozen, options.cycle) {
        assemble_elements(elements, Coefficients::Zero(elements.finest().unknown_count(), 3),
                          {1, step}, systems);
        Stabilization(elements).add(options.stabilization, step, systems.matrices);
        multigrid.refresh(systems.matrices);
        multigrid.finest().assemble(systems.right_sides, right_side);
    }

    double residual(const Field& x) const {
        Field r;
        multigrid.finest().residual(right_side, x, r);
        return norm(r);
    }
    Field zero() const { return Field::Zero(4, elements.finest().unknown_count()); }

    TrackedElements elements;
    std::vector<std::vector<std::uint8_t>> frozen;
    Multigrid multigrid;
    ElementSystems systems;
    Field right_side;
};

/// A times a random field. Something random itself would be all but noise on the nearly dependent
/// functions, beside which the rest of an operator hardly shows.
inline Field random_right_side(const System& system) {
    Field random = Field::Random(4, system.right_side.cols());
    random.row(3).setZero();
    Field right_side;
    system.multigrid.finest().multiply(random, right_side);
    return right_side;
}

using Dense = Eigen::MatrixXd;

inline Dense dense(const SparseMatrix& matrix) {
    return Eigen::MatrixXf(matrix).cast<double>();
}

}  // namespace tracked_mcf
