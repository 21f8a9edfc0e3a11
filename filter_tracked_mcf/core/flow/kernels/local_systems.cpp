// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/kernels/local_systems.h"

#include "filter_tracked_mcf/core/flow/kernels/lanes.h"

namespace tracked_mcf::kernels {

namespace {

/// A pivot below this fraction of its diagonal entry is a rounding error: its function depends on
/// the functions before it, and its row is left out.
constexpr float kDependent = 1e-5F;

/// The lower triangles of the matrices of a block. Equal entries are neighbours, as in a
/// MatrixBlock.
struct Triangles {
    alignas(64) float entry[8][8][kBlockElements];
};

inline bool is_without_place(std::uint32_t without_place, int i, int j) {
    return ((without_place >> kCouplingIndices.bit[i][j]) & 1U) != 0;
}

/// Reads the lower triangle of the assembled matrix, restricted to the unknowns of one element.
void restrict(const CoupledElements& range, std::int32_t element, const MatrixBlock& own,
              const Couplings* couplings, Triangles& triangles, int lane) {
    const std::int32_t* const unknowns = range.unknowns + std::int64_t{8} * element;
    for (int j = 0; j < 8; ++j) {
        const float* const sum = couplings[unknowns[j]].sum;
        for (int i = j; i < 8; ++i) {
            // Since j <= i, the Couplings of the unknown at corner j contain the entry (i, j).
            triangles.entry[i][j][lane] = sum[kCouplingIndices.of[i][j]];
        }
    }
    const std::uint32_t without_place = range.without_place[element];
    if (without_place == 0) return;
    for (int i = 0; i < 8; ++i) {
        for (int j = 0; j < i; ++j) {
            if (!is_without_place(without_place, i, j)) continue;
            triangles.entry[i][j][lane] = own.entry[kEntryIndices.of[i][j]][lane];
        }
    }
}

/// Inverts kLanes symmetric positive semi-definite matrices in place, as L⁻ᵀ D⁻¹ L⁻¹. This is a sum
/// of squares, so it is positive despite rounding errors; an inverse by elimination need not be.
/// Rows that are left out become zero.
inline void invert(Lanes (&m)[8][8]) {
    Lanes least[8];
    Lanes inverse_pivot[8];
    for (int k = 0; k < 8; ++k) least[k] = splat(kDependent) * m[k][k];
    // Factorise into L, below the diagonal, and D.
    for (int k = 0; k < 8; ++k) {
        const Lanes pivot = m[k][k];
        // Written so that a NaN propagates.
        for (int lane = 0; lane < kLanes; ++lane) {
            inverse_pivot[k][lane] = pivot[lane] <= least[k][lane] ? 0 : 1 / pivot[lane];
        }
        Lanes column[8];
        for (int i = k + 1; i < 8; ++i) column[i] = m[i][k];
        for (int i = k + 1; i < 8; ++i) {
            const Lanes factor = column[i] * inverse_pivot[k];
            for (int j = k + 1; j <= i; ++j) m[i][j] -= factor * column[j];
            m[i][k] = factor;
        }
    }
    // Replace L by L⁻¹ below the diagonal.
    for (int i = 0; i < 8; ++i) {
        for (int j = 0; j < i; ++j) {
            Lanes sum = m[i][j];
            for (int k = j + 1; k < i; ++k) sum = m[i][k] * m[k][j] + sum;
            m[i][j] = -sum;
        }
    }
    for (int i = 0; i < 8; ++i) {
        for (int j = 0; j <= i; ++j) {
            Lanes sum = j < i ? inverse_pivot[i] * m[i][j] : inverse_pivot[i];
            for (int k = i + 1; k < 8; ++k) {
                sum = inverse_pivot[k] * m[k][i] * m[k][j] + sum;
            }
            m[i][j] = sum;
        }
    }
}

/// Inverts the matrices of kLanes elements of a block, from this lane of the block on.
void invert(const Triangles& triangles, const float (&factors)[kBlockElements], int lane,
            MatrixBlock& inverses) {
    Lanes m[8][8];
    for (int i = 0; i < 8; ++i) {
        for (int j = 0; j <= i; ++j) m[i][j] = load(triangles.entry[i][j] + lane);
    }
    invert(m);
    for (int j = 0; j < 8; ++j) {
        for (int i = j; i < 8; ++i) {
            store(load(factors + lane) * m[i][j], inverses.entry[kEntryIndices.of[i][j]] + lane);
        }
    }
}

}  // namespace

}  // namespace tracked_mcf::kernels

namespace tracked_mcf {

using namespace kernels;

void sum_couplings(const CoupledElements& range, const MatrixBlock* matrices,
                   Couplings* couplings) {
    for (std::int32_t element = range.begin; element < range.end; ++element) {
        const std::int32_t* const unknowns = range.unknowns + std::int64_t{8} * element;
        const std::uint32_t without_place = range.without_place[element];
        const MatrixBlock& block = matrices[element / kBlockElements];
        const int lane = element % kBlockElements;
        for (int i = 0; i < 8; ++i) {
            float* const sum = couplings[unknowns[i]].sum;
            for (int j = i; j < 8; ++j) {
                if (without_place != 0 && is_without_place(without_place, i, j)) continue;
                sum[kCouplingIndices.of[i][j]] += block.entry[kEntryIndices.of[i][j]][lane];
            }
        }
    }
}

void invert_locally(const CoupledElements& range, const MatrixBlock* matrices,
                    const Couplings* couplings, const float* damping, MatrixBlock* inverses) {
    for (std::int32_t first = range.begin; first < range.end; first += kBlockElements) {
        const std::int32_t left = range.end - first;
        const int count = left < kBlockElements ? left : kBlockElements;
        const std::int32_t block = first / kBlockElements;
        Triangles triangles;
        if (count < kBlockElements) triangles = Triangles{};
        alignas(64) float factors[kBlockElements] = {};
        for (int lane = 0; lane < count; ++lane) {
            restrict(range, first + lane, matrices[block], couplings, triangles, lane);
            factors[lane] = damping[first + lane];
        }
        for (int lane = 0; lane < kBlockElements; lane += kLanes) {
            invert(triangles, factors, lane, inverses[block]);
        }
    }
}

}  // namespace tracked_mcf
