#pragma once

#include <Eigen/Core>
#include <vector>

#include "filter_tracked_mcf/core/element_matrices.h"
#include "filter_tracked_mcf/core/element_multigrid.h"
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

/// What a flow's first step is made of on some mesh.
struct FirstStep {
    FirstStep(const TriangleMesh& mesh, int depth, float step, const SystemOptions& options)
        : elements(
              build_tracked_elements(mesh, enclosing_grid(mesh, depth), Cubature::ThreePoints)),
          frozen(options.lock ? unknowns_meeting_held_edges(elements) : no_unknowns(elements)) {
        assemble_elements(elements, Coefficients::Zero(elements.finest().unknown_count(), 3),
                          {1, step}, systems);
        Stabilization(elements).add(options.stabilization, step, systems.matrices);
    }
    Field zero() const { return Field::Zero(4, elements.finest().unknown_count()); }

    TrackedElements elements;
    std::vector<std::vector<std::uint8_t>> frozen;
    ElementSystems systems;
};

/// A flow's system on some mesh, at the first step, and the paper's solver for it.
struct System : FirstStep {
    System(const TriangleMesh& mesh, int depth, float step, const SystemOptions& options = {})
        : FirstStep(mesh, depth, step, options), multigrid(elements, frozen, options.cycle) {
        multigrid.refresh(systems.matrices);
        multigrid.finest().assemble(systems.right_sides, right_side);
    }

    double residual(const Field& x) const {
        Field r;
        multigrid.finest().residual(right_side, x, r);
        return norm(r);
    }
    Multigrid multigrid;
    Field right_side;
};

/// The same with the multigrid that preconditions conjugate gradients.
struct ElementSystem : FirstStep {
    ElementSystem(const TriangleMesh& mesh, int depth, float step,
                  const SystemOptions& options = {})
        : FirstStep(mesh, depth, step, options), multigrid(elements, frozen) {
        multigrid.refresh(systems.matrices, step);
        multigrid.assemble(systems.right_sides, right_side);
    }

    ElementMultigrid multigrid;
    Field right_side;
};

inline Field random_field(const FirstStep& step) {
    Field random = Field::Random(4, step.elements.finest().unknown_count());
    random.row(3).setZero();
    return random;
}

/// A times a random field. Something random itself would be all but noise on the nearly dependent
/// functions, beside which the rest of an operator hardly shows.
inline Field random_right_side(const ElementSystem& system) {
    Field right_side;
    system.multigrid.multiply(random_field(system), right_side);
    return right_side;
}

using Dense = Eigen::MatrixXd;

inline Dense dense(const SparseMatrix& matrix) {
    return Eigen::MatrixXf(matrix).cast<double>();
}

/// The sum of a level's element matrices.
inline Dense assembled(const Level& level, const MatrixBlocks& matrices) {
    Dense sum = Dense::Zero(level.unknown_count(), level.unknown_count());
    for (std::int32_t element = 0; element < level.element_count(); ++element) {
        const auto& unknowns = level.unknowns[element];
        for (int i = 0; i < 8; ++i) {
            for (int j = 0; j < 8; ++j) {
                sum(unknowns[i], unknowns[j]) += matrices.at(element, i, j);
            }
        }
    }
    return sum;
}

/// Of the finest level.
inline Dense assembled(const FirstStep& step) {
    return assembled(step.elements.finest(), step.systems.matrices);
}

}  // namespace tracked_mcf
