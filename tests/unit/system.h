// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "filter_tracked_mcf/core/solver/element_multigrid.h"
#include "filter_tracked_mcf/core/solver/paper/multigrid.h"
#include "filter_tracked_mcf/core/system/constrained_cells.h"
#include "filter_tracked_mcf/core/system/element_matrices.h"
#include "filter_tracked_mcf/core/system/stabilization.h"
#include "tests/support/elements.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {

/// Options of a System.
struct SystemOptions {
    bool lock = false;         ///< constrain the cells of the boundary
    double stabilization = 0;  ///< weight
};

/// The system of a flow's first step on a mesh.
struct FirstStep {
    FirstStep(const TriangleMesh& mesh, int depth, float step, const SystemOptions& options)
        : elements(
              build_tracked_elements(mesh, enclosing_grid(mesh, depth), Cubature::ThreePoints)),
          constrained(constrained_unknowns(
              elements, options.lock ? BoundaryCondition::LockedCells : BoundaryCondition::Free)) {
        assemble_elements(elements, Coefficients::Zero(elements.finest().unknown_count(), 3),
                          {1, step}, systems);
        Stabilization(elements).add(options.stabilization, step, systems.matrices);
    }
    Field zero() const { return Field::Zero(4, elements.finest().unknown_count()); }

    TrackedElements elements;
    std::vector<std::vector<std::uint8_t>> constrained;
    ElementSystems systems;
};

/// The system of the first step with the paper's solver.
struct System : FirstStep {
    System(const TriangleMesh& mesh, int depth, float step, const SystemOptions& options = {})
        : FirstStep(mesh, depth, step, options), multigrid(elements, constrained) {
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

/// The system of the first step with the multigrid that preconditions conjugate gradients.
struct ElementSystem : FirstStep {
    ElementSystem(const TriangleMesh& mesh, int depth, float step,
                  const SystemOptions& options = {})
        : FirstStep(mesh, depth, step, options), multigrid(elements.levels, constrained) {
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

/// Returns A times a random field. A random right-hand side would mostly excite nearly dependent
/// functions, which would hide all other errors of an operator.
inline Field random_right_side(const ElementSystem& system) {
    Field right_side;
    system.multigrid.multiply(random_field(system), right_side);
    return right_side;
}

using Dense = Eigen::MatrixXd;

inline Dense dense(const SparseMatrix& matrix) {
    return Eigen::MatrixXf(matrix).cast<double>();
}

/// Returns the sum of a level's element matrices.
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

/// Returns the finest level's matrix.
inline Dense assembled(const FirstStep& step) {
    return assembled(step.elements.finest(), step.systems.matrices);
}

/// Returns a field as one row per unknown.
inline Dense as_dense(const Field& field) {
    return field.cast<double>().transpose();
}

/// Two nearby sheets, so that several unknowns are at one corner.
inline TriangleMesh two_shells() {
    const TriangleMesh sphere = shapes::bumpy_sphere(20);
    return shapes::merged(sphere,
                          shapes::transformed(sphere, Eigen::Affine3d(Eigen::Scaling(0.97))));
}

}  // namespace tracked_mcf
