#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/element_matrices.h"
#include "filter_tracked_mcf/core/field.h"
#include "filter_tracked_mcf/core/level_matrix.h"
#include "filter_tracked_mcf/core/octree.h"

namespace tracked_mcf {

/// Multiplicative Schwarz over the elements: one after the other, the eight unknowns of an element
/// are solved for together, the rest held.
///
/// What makes these systems hard is that the functions around an element are nearly dependent on
/// the surface in it; Gauss-Seidel, which moves one of them at a time, takes tens of sweeps for
/// what a solve of all eight does at once.
///
/// The order is that of eight colours of blocks of cells, so that blocks of one colour do not touch
/// and can go in parallel, and that of the elements inside a block. Neither depends on the number
/// of threads, so the bits do not either.
class ElementSmoother {
public:
    explicit ElementSmoother(const Level& level);

    /// Takes the level's matrix, whose numbers have changed.
    void refresh(const LevelMatrix& matrix);

    /// One sweep over A x = right_side, in place, with the matrix of the last refresh. Unknowns
    /// with inverse diagonal 0 stay.
    void sweep(const LevelMatrix& matrix, const Field& right_side, Field& x) const;

    /// The same in exactly the opposite order, which makes it the adjoint of sweep in the energy of
    /// A.
    void sweep_backward(const LevelMatrix& matrix, const Field& right_side, Field& x) const;

private:
    struct Block {
        std::int32_t begin, end;  ///< elements
    };

    const Level& level_;
    std::array<std::vector<Block>, 8> colours_;
    std::vector<ElementMatrix> inverses_;  ///< of A restricted to each element's unknowns
};

}  // namespace tracked_mcf
