#pragma once

#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/element_matrices.h"
#include "filter_tracked_mcf/core/field.h"
#include "filter_tracked_mcf/core/matrix_blocks.h"
#include "filter_tracked_mcf/core/octree.h"
#include "filter_tracked_mcf/core/sorting.h"
#include "filter_tracked_mcf/core/sparse_matrix.h"

namespace tracked_mcf {

/// A level's system matrix over its unknowns. The pattern is fixed by the octree and made once; the
/// numbers are refreshed from element matrices at every step. Rows are summed independently of each
/// other in a fixed order, hence to the same bits at any number of threads.
class LevelMatrix {
public:
    /// Makes the pattern of `level`, which must outlive this, with unset numbers.
    explicit LevelMatrix(const Level& level);

    /// Sums the element matrices, one per element of the level. Afterwards frozen unknowns, and
    /// those whose row has nothing on its diagonal (no sample in their support contributes), have
    /// inverse_diagonal 0, so that no smoother ever moves them.
    void assemble(const MatrixBlocks& elements, const std::vector<std::uint8_t>& frozen);

    const SparseMatrix& matrix() const { return matrix_; }
    const std::vector<float>& inverse_diagonal() const { return inverse_diagonal_; }

    /// Sums element vectors in the same way.
    void assemble(const std::vector<ElementVector>& elements, Field& vector) const;

    /// residual = right_side - A x, zero for unknowns that are not to move.
    void residual(const Field& right_side, const Field& x, Field& residual) const;

    /// The same for a solution in double precision, a row per unknown, computed in double.
    void residual(const Field& right_side, const Coefficients& x, Field& residual) const;

    /// product = A x, zero for unknowns that are not to move.
    void multiply(const Field& x, Field& product) const;

private:
    void make_pattern();
    void assemble_row(std::int32_t row, const MatrixBlocks& elements,
                      std::vector<float>& sums) const;
    void store_row(std::int32_t row, std::vector<float>& sums);

    /// Sets every column of `result` to of_row(row), or to zero if its unknown is not to move.
    template <class OfRow>
    void fill(Field& result, const OfRow& of_row) const;

    const Level& level_;
    Groups places_;  ///< of every unknown: 8 * element + corner, wherever it occurs
    SparseMatrix matrix_;
    std::vector<float> inverse_diagonal_;
};

}  // namespace tracked_mcf
