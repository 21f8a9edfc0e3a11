#include "filter_tracked_mcf/core/element_smoother.h"

#include <array>

#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/morton.h"
#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

namespace {

/// A block is a cube of 2^3 cells a side: about a hundred elements, few of them at its rim.
constexpr unsigned kBlockBits = 3 * 3;

/// Blocks of one colour that outweigh waking and joining threads.
constexpr std::int64_t kElementBlocksWorthThreads = 8;

/// A pivot that elimination has brought below this fraction of the diagonal is rounding: its
/// function depends on those before it, and is left to them.
constexpr float kDependent = 1e-5F;

/// The entries of the matrix between the unknowns of one element, zero for those that stay.
ElementMatrix restricted(const LevelMatrix& matrix, const std::array<std::int32_t, 8>& unknowns) {
    ElementMatrix result{};
    const SparseMatrix& sparse = matrix.matrix();
    for (int row = 0; row < 8; ++row) {
        if (matrix.inverse_diagonal()[unknowns[row]] == 0) continue;
        for (int column = 0; column < 8; ++column) {
            if (matrix.inverse_diagonal()[unknowns[column]] == 0) continue;
            result.entry[row][column] = sparse.coeff(unknowns[row], unknowns[column]);
        }
    }
    return result;
}

void leave_out(ElementMatrix& m, int k) {
    for (int i = 0; i < 8; ++i) m.entry[k][i] = m.entry[i][k] = 0;
}

/// One step of Beaton's sweep operator (1964): solves the k-th equation for the k-th unknown and
/// inserts that in the others. After all steps the matrix has become minus its inverse.
void sweep_pivot(ElementMatrix& m, int k) {
    const float inverse_pivot = 1 / m.entry[k][k];
    for (int i = 0; i < 8; ++i) {
        if (i == k) continue;
        const float factor = m.entry[i][k] * inverse_pivot;
        for (int j = 0; j < 8; ++j) m.entry[i][j] -= factor * m.entry[k][j];
        m.entry[i][k] = factor;
    }
    for (float& entry : m.entry[k]) entry *= inverse_pivot;
    m.entry[k][k] = -inverse_pivot;
}

/// Inverts a symmetric positive semi-definite matrix in place. Rows that are zero or depend on
/// those before become zero: what is left is the inverse over the others.
void invert(ElementMatrix& m) {
    std::array<float, 8> diagonal;
    for (int k = 0; k < 8; ++k) diagonal[k] = m.entry[k][k];
    for (int k = 0; k < 8; ++k) {
        if (m.entry[k][k] > kDependent * diagonal[k]) {
            sweep_pivot(m, k);
        } else {
            leave_out(m, k);
        }
    }
    for (auto& row : m.entry) {
        for (float& entry : row) entry = -entry;
    }
}

/// Calls body(block), in parallel where there are enough of them.
template <class Block, class Body>
void for_each_block(const std::vector<Block>& blocks, const Body& body) {
    parallel_for(
        static_cast<std::int64_t>(blocks.size()), [&](std::int64_t i) { body(blocks[i]); },
        kElementBlocksWorthThreads);
}

/// Solves for the unknowns of one element.
void relax(const LevelMatrix& matrix, const Field& right_side, const ElementMatrix& inverse,
           const std::array<std::int32_t, 8>& unknowns, Field& x) {
    Eigen::Vector4f residual[8];
    for (int i = 0; i < 8; ++i) {
        residual[i] = right_side.col(unknowns[i]) - row_times(matrix.matrix(), unknowns[i], x);
    }
    for (int i = 0; i < 8; ++i) {
        Eigen::Vector4f correction = Eigen::Vector4f::Zero();
        for (int j = 0; j < 8; ++j) correction += inverse.entry[i][j] * residual[j];
        x.col(unknowns[i]) += correction;
    }
}

}  // namespace

ElementSmoother::ElementSmoother(const Level& level) : level_(level) {
    resize(inverses_, level.element_count());
    const auto block_of = [&](std::int32_t element) { return level.cells[element] >> kBlockBits; };
    const std::int32_t count = level.element_count();
    for (std::int32_t begin = 0, end = 0; begin < count; begin = end) {
        while (end < count && block_of(end) == block_of(begin)) ++end;
        colours_[octant_of(block_of(begin))].push_back({begin, end});
    }
}

void ElementSmoother::refresh(const LevelMatrix& matrix) {
    parallel_for_rows(level_.element_count(), [&](std::int32_t element) {
        inverses_[element] = restricted(matrix, level_.unknowns[element]);
        invert(inverses_[element]);
    });
}

void ElementSmoother::sweep(const LevelMatrix& matrix, const Field& right_side, Field& x) const {
    for (const std::vector<Block>& blocks : colours_) {
        for_each_block(blocks, [&](const Block& block) {
            for (std::int32_t element = block.begin; element < block.end; ++element) {
                relax(matrix, right_side, inverses_[element], level_.unknowns[element], x);
            }
        });
    }
}

void ElementSmoother::sweep_backward(const LevelMatrix& matrix, const Field& right_side,
                                     Field& x) const {
    for (auto blocks = colours_.rbegin(); blocks != colours_.rend(); ++blocks) {
        for_each_block(*blocks, [&](const Block& block) {
            for (std::int32_t element = block.end; element-- > block.begin;) {
                relax(matrix, right_side, inverses_[element], level_.unknowns[element], x);
            }
        });
    }
}

}  // namespace tracked_mcf
