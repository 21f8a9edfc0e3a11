// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/kernels/local_systems.h"

namespace tracked_mcf {

namespace {

/// A pivot below this fraction of its diagonal entry is a rounding error: its function depends on
/// the functions before it, and its row is left out.
constexpr float kDependent = 1e-5F;

/// One entry of all matrices of a block. The matrices of a block are inverted side by side.
using Lanes = float __attribute__((vector_size(4 * kBlockElements)));

/// The lower triangles of the matrices of a block.
struct Triangles {
    Lanes entry[8][8];
};

bool is_unshared(std::uint32_t unshared, int i, int j) {
    return ((unshared >> kCouplingIndices.bit[i][j]) & 1U) != 0;
}

/// Reads the lower triangle of the assembled matrix, restricted to the unknowns of one element.
void restrict(const CoupledElements& range, std::int32_t element, const MatrixBlock& own,
              const Couplings* couplings, Triangles& triangles, int lane) {
    const std::int32_t* const unknowns = range.unknowns + std::int64_t{8} * element;
#pragma GCC unroll 8
    for (int j = 0; j < 8; ++j) {
        const float* const sum = couplings[unknowns[j]].sum;
#pragma GCC unroll 8
        for (int i = j; i < 8; ++i) {
            // Since j <= i, the Couplings of the unknown at corner j contain the entry (i, j).
            triangles.entry[i][j][lane] = sum[kCouplingIndices.of[i][j]];
        }
    }
    const std::uint32_t unshared = range.unshared[element];
    if (unshared == 0) return;
    for (int i = 0; i < 8; ++i) {
        for (int j = 0; j < i; ++j) {
            if (!is_unshared(unshared, i, j)) continue;
            triangles.entry[i][j][lane] = own.entry[kEntryIndices.of[i][j]][lane];
        }
    }
}

/// Inverts symmetric positive semi-definite matrices in place, as L⁻ᵀ D⁻¹ L⁻¹. This is a sum of
/// squares, so it is positive despite rounding errors; an inverse by elimination need not be. Rows
/// that are left out become zero.
void invert(Triangles& m) {
    Lanes least[8];
    Lanes inverse_pivot[8];
    for (int k = 0; k < 8; ++k) least[k] = kDependent * m.entry[k][k];
        // Factorise into L, below the diagonal, and D.
#pragma GCC unroll 8
    for (int k = 0; k < 8; ++k) {
        const Lanes pivot = m.entry[k][k];
        // Written so that a NaN propagates.
        inverse_pivot[k] = pivot <= least[k] ? Lanes{} : 1 / pivot;
        Lanes column[8];
#pragma GCC unroll 8
        for (int i = k + 1; i < 8; ++i) column[i] = m.entry[i][k];
#pragma GCC unroll 8
        for (int i = k + 1; i < 8; ++i) {
            const Lanes factor = column[i] * inverse_pivot[k];
#pragma GCC unroll 8
            for (int j = k + 1; j <= i; ++j) m.entry[i][j] -= factor * column[j];
            m.entry[i][k] = factor;
        }
    }
    // Replace L by L⁻¹ below the diagonal.
#pragma GCC unroll 8
    for (int i = 0; i < 8; ++i) {
#pragma GCC unroll 8
        for (int j = 0; j < i; ++j) {
            Lanes sum = m.entry[i][j];
#pragma GCC unroll 8
            for (int k = j + 1; k < i; ++k) sum += m.entry[i][k] * m.entry[k][j];
            m.entry[i][j] = -sum;
        }
    }
#pragma GCC unroll 8
    for (int i = 0; i < 8; ++i) {
#pragma GCC unroll 8
        for (int j = 0; j <= i; ++j) {
            Lanes sum = j < i ? inverse_pivot[i] * m.entry[i][j] : inverse_pivot[i];
#pragma GCC unroll 8
            for (int k = i + 1; k < 8; ++k) {
                sum += inverse_pivot[k] * m.entry[k][i] * m.entry[k][j];
            }
            m.entry[i][j] = sum;
        }
    }
}

void store(const Triangles& triangles, const Lanes& factors, MatrixBlock& inverses) {
    float* entry = inverses.entry[0];
#pragma GCC unroll 8
    for (int j = 0; j < 8; ++j) {
#pragma GCC unroll 8
        for (int i = j; i < 8; ++i, entry += kBlockElements) {
            const Lanes scaled = factors * triangles.entry[i][j];
            __builtin_memcpy(entry, &scaled, sizeof scaled);
        }
    }
}

}  // namespace

namespace TRACKED_MCF_KERNELS {

void sum_couplings(const CoupledElements& range, const MatrixBlock* matrices,
                   Couplings* couplings) {
    for (std::int32_t element = range.begin; element < range.end; ++element) {
        const std::int32_t* const unknowns = range.unknowns + std::int64_t{8} * element;
        const std::uint32_t unshared = range.unshared[element];
        const MatrixBlock& block = matrices[element / kBlockElements];
        const int lane = element % kBlockElements;
#pragma GCC unroll 8
        for (int i = 0; i < 8; ++i) {
            float* const sum = couplings[unknowns[i]].sum;
#pragma GCC unroll 8
            for (int j = i; j < 8; ++j) {
                if (unshared != 0 && is_unshared(unshared, i, j)) continue;
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
        Lanes factors = {};
        for (int lane = 0; lane < count; ++lane) {
            restrict(range, first + lane, matrices[block], couplings, triangles, lane);
            factors[lane] = damping[first + lane];
        }
        invert(triangles);
        store(triangles, factors, inverses[block]);
    }
}

}  // namespace TRACKED_MCF_KERNELS

}  // namespace tracked_mcf
