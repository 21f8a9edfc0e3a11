// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "filter_tracked_mcf/core/flow/cells/bspline.h"
#include "filter_tracked_mcf/core/flow/solver/paper/multigrid.h"
#include "filter_tracked_mcf/core/flow/solver/vertex_octree.h"
#include "filter_tracked_mcf/core/flow/system/constrained_cells.h"
#include "filter_tracked_mcf/core/flow/system/element_matrices.h"
#include "tests/support/elements.h"
#include "tests/support/shapes.h"
#include "tests/unit/mesh_system.h"

namespace tracked_mcf {

/// Levels of an octree, coarsest first, and the matrices of the finest elements.
struct LevelSystem {
    const Level& finest() const { return levels.back(); }

    std::vector<Level> levels;
    MatrixBlocks matrices;
};

/// Returns those of a flow's first step on the octree that preconditions: the one of the mesh's
/// vertices, in which close sheets have elements of their own. `step` is in squared cells.
inline LevelSystem vertex_system(const TriangleMesh& mesh, int depth, double step) {
    const Surface surface = surface_of(mesh);
    const Grid grid = grid_around(surface.positions, depth);
    const VertexOctree octree(surface.stars, surface.positions, grid);
    const TriangleElements elements = elements_of(surface);
    MeshSystem system(surface.stars, surface.held, surface.parts);
    system.take(elements, step * grid.cell_size * grid.cell_size);
    LevelSystem result{octree.levels(), {}};
    octree.assemble(system, elements, result.matrices);
    return result;
}

/// The system of the first step of the paper's flow on a mesh. `step` is in squared cells.
struct FirstStep {
    FirstStep(const TriangleMesh& mesh, int depth, double step, bool lock = false)
        : elements(
              build_tracked_elements(mesh, enclosing_grid(mesh, depth), Cubature::ThreePoints)),
          constrained(constrained_unknowns(elements)) {
        if (!lock) {
            for (auto& level : constrained) std::fill(level.begin(), level.end(), std::uint8_t{0});
        }
        assemble_elements(elements, Coefficients::Zero(elements.finest().unknown_count(), 3), step,
                          false, systems);
    }
    Field zero() const { return Field::Zero(4, elements.finest().unknown_count()); }
    LevelSystem levels() const { return {elements.levels, systems.matrices}; }

    TrackedElements elements;
    std::vector<std::vector<std::uint8_t>> constrained;
    ElementSystems systems;
};

/// The same with the paper's solver.
struct System : FirstStep {
    System(const TriangleMesh& mesh, int depth, double step, bool lock = false)
        : FirstStep(mesh, depth, step, lock), multigrid(elements, constrained) {
        multigrid.refresh(systems.matrices);
        sum_at_unknowns(elements.finest(), systems.right_sides, right_side);
    }

    double residual(const Field& x) const {
        Field r;
        multigrid.finest().residual(right_side, x, r);
        return norm(r);
    }
    Multigrid multigrid;
    Field right_side;
};

inline Field random_field(const Level& level) {
    Field random = Field::Random(4, level.unknown_count());
    random.row(3).setZero();
    return random;
}

/// Returns the product of the matrix of a system's finest level and a vector.
inline Field times(const LevelSystem& system, const Field& x) {
    const Level& level = system.finest();
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(4, level.unknown_count());
    for (std::int32_t element = 0; element < level.element_count(); ++element) {
        const auto& unknowns = level.unknowns[element];
        for (int i = 0; i < 8; ++i) {
            for (int j = 0; j < 8; ++j) {
                sum.col(unknowns[i]) +=
                    system.matrices[element](i, j) * x.col(unknowns[j]).cast<double>();
            }
        }
    }
    return sum.cast<float>();
}

/// Returns A times a random field. A random right-hand side would mostly excite nearly dependent
/// functions, which would hide all other errors of an operator.
inline Field random_right_side(const LevelSystem& system) {
    return times(system, random_field(system.finest()));
}

using Dense = Eigen::MatrixXd;

inline Dense dense(const SparseMatrix& matrix) {
    return Eigen::MatrixXf(matrix).cast<double>();
}

/// Returns P, with the refinement weights of each octant.
inline Dense prolongation(const Level& fine, const Level& coarse) {
    Dense p = Dense::Zero(fine.unknown_count(), coarse.unknown_count());
    for (std::int32_t element = 0; element < fine.element_count(); ++element) {
        const auto weights = refinement_weights(octant_of(fine.cells[element]));
        for (int i = 0; i < 8; ++i) {
            for (int j = 0; j < 8; ++j) {
                p(fine.unknowns[element][i], coarse.unknowns[fine.parents[element]][j]) =
                    weights(i, j);
            }
        }
    }
    return p;
}

/// Returns the sum of a level's element matrices.
inline Dense assembled(const Level& level, const MatrixBlocks& matrices) {
    Dense sum = Dense::Zero(level.unknown_count(), level.unknown_count());
    for (std::int32_t element = 0; element < level.element_count(); ++element) {
        const auto& unknowns = level.unknowns[element];
        for (int i = 0; i < 8; ++i) {
            for (int j = 0; j < 8; ++j) {
                sum(unknowns[i], unknowns[j]) += matrices[element](i, j);
            }
        }
    }
    return sum;
}

/// Returns the finest level's matrix.
inline Dense assembled(const LevelSystem& system) {
    return assembled(system.finest(), system.matrices);
}

/// Returns a field as one row per unknown.
inline Dense as_dense(const Field& field) {
    return field.cast<double>().transpose();
}

/// Two nearby sheets, so that several unknowns of an octree of vertices are at one corner.
inline TriangleMesh two_shells() {
    const TriangleMesh sphere = shapes::bumpy_sphere(20);
    return shapes::merged(sphere,
                          shapes::transformed(sphere, Eigen::Affine3d(Eigen::Scaling(0.97))));
}

}  // namespace tracked_mcf
