// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "tests/research/benchmark/triangle_indices.h"

namespace tracked_mcf::benchmark {

/// A number for each coordinate, and a fourth that is always 0, for vector instructions.
struct alignas(16) Floats {
    float value[4] = {0, 0, 0, 0};
};
struct alignas(32) Doubles {
    double value[4] = {0, 0, 0, 0};
};

/// An entry right of the diagonal, for the backward sweep and the product with the matrix.
struct UpperEntry {
    std::int32_t column;
    float factor;  ///< of L, transposed
    float matrix;
};

/// An entry left of the diagonal, for the forward sweep.
struct LowerEntry {
    std::int32_t column;
    float factor;
};

/// The triangles to assemble, and the arrays that they add to.
///
/// The matrix A is stored by its off-diagonal entries a_ij and its row sums, the lumped masses:
/// A x_i = sum_i x_i + Σ_j a_ij (x_j - x_i). This form keeps its accuracy in single precision if x
/// varies slowly and δ S, whose row sums are 0, is much larger than M.
struct Assembly {
    const TriangleIndices* triangles;
    std::int64_t count;
    const Doubles* positions;
    double step_size;  ///< δ, squared units of the mesh
    double scale;      ///< factor of the whole system
    UpperEntry* entries;
    float* row_sums;
    Doubles* right_side;  ///< -δ S x
};

/// The rows of one block. All arrays are indexed by rows and entries of the whole matrix.
struct Block {
    std::int32_t begin, end;
    const std::int32_t* upper_begin;
    const std::int32_t* lower_begin;
    const std::int32_t* lower_index;
    const std::int32_t* fill_begin;
    const std::int32_t* fill;
    UpperEntry* upper;
    LowerEntry* lower;
    const float* row_sums;
    const float* diagonal;    ///< of the matrix that is factorised
    float* inverse_diagonal;  ///< of the pivots
    Floats *x, *r, *z, *p, *q;
};

/// The loops that take nearly all time, compiled for several instruction sets.
struct CotangentKernels {
    const char* name;

    void (*assemble)(const Assembly& assembly);

    /// Computes the incomplete factorisation L D Lᵀ of the block without its positive off-diagonal
    /// entries. Obtuse triangles cause these. The remainder is an M-matrix, so the factorisation
    /// exists. Omits fill without an entry in the matrix, and adds `relaxation` times this fill to
    /// the diagonal: 0 is IC(0), 1 is modified IC(0). `diagonal` is the M-matrix's diagonal.
    void (*factorize)(const Block& block, float relaxation);

    /// Computes q = A x.
    void (*multiply)(const Block& block);

    /// Computes r -= alpha q and z = L⁻¹ r. Adds r·r and r·(L D Lᵀ)⁻¹ r of each coordinate.
    void (*forward)(const Block& block, const Floats& alpha, Doubles& residual, Doubles& product);

    /// Computes x += alpha p, z = L⁻ᵀ D⁻¹ z, p = z + beta p and q = A p. Adds p·q of each
    /// coordinate.
    void (*backward)(const Block& block, const Floats& alpha, const Floats& beta, Doubles& product);
};

/// Returns the fastest kernels for this processor, or the ones for every processor if the
/// environment variable TRACKED_MCF_INSTRUCTIONS is "baseline".
const CotangentKernels& cotangent_kernels();

}  // namespace tracked_mcf::benchmark
