#pragma once

#include <cstdint>

#include "tests/benchmark/triangle_places.h"

namespace tracked_mcf::benchmark {

/// A number for each coordinate, and one more that is always 0, so that all are handled at once.
struct alignas(16) Floats {
    float value[4] = {0, 0, 0, 0};
};
struct alignas(32) Doubles {
    double value[4] = {0, 0, 0, 0};
};

/// Right of the diagonal: what the backward sweep and the product with the matrix need.
struct UpperEntry {
    std::int32_t column;
    float factor;  ///< of L, transposed
    float matrix;
};

/// Left of the diagonal: what the forward sweep needs.
struct LowerEntry {
    std::int32_t column;
    float factor;
};

/// The triangles to assemble and where to.
///
/// The matrix is that of A x_i = sum_i x_i + Σ_j a_ij (x_j - x_i): by its off-diagonal entries a_ij
/// and the sums of its rows, which are the lumped masses. In single precision this form loses
/// nothing where x varies slowly and δ S, whose rows sum up to 0, is much larger than M.
struct Assembly {
    const TrianglePlaces* triangles;
    std::int64_t count;
    const Doubles* positions;
    double step_size;  ///< δ, squared units of the mesh
    double scale;      ///< multiplies all that is assembled
    UpperEntry* entries;
    float* row_sums;
    Doubles* right_side;  ///< -δ S x
};

/// The rows of one block, and all vectors by row. `upper_begin` and `lower_begin` are of all rows.
struct Block {
    std::int32_t begin, end;
    const std::int32_t* upper_begin;
    const std::int32_t* lower_begin;
    const std::int32_t* lower_place;
    const std::int32_t* fill_begin;
    const std::int32_t* fill;
    UpperEntry* upper;
    LowerEntry* lower;
    const float* row_sums;
    const float* diagonal;    ///< of the matrix to be factorised
    float* inverse_diagonal;  ///< of the pivots
    Floats *x, *r, *z, *p, *q;
};

/// The loops in which all time is spent, compiled for several sets of instructions.
struct CotangentKernels {
    const char* name;

    void (*assemble)(const Assembly& assembly);

    /// L D Lᵀ of the block without its positive off-diagonal entries, which obtuse triangles make:
    /// what is left is an M-matrix, of which the incomplete factorisation always exists. Fill that
    /// the matrix has no entry for is left out; `relaxation` of it goes to the diagonal: 0 is
    /// IC(0), 1 modified IC(0). `diagonal` is that of the M-matrix.
    void (*factorize)(const Block& block, float relaxation);

    /// q = A x.
    void (*multiply)(const Block& block);

    /// r -= alpha q, z = L⁻¹ r; sums are (r·r, r·(L D Lᵀ)⁻¹ r) of each coordinate.
    void (*forward)(const Block& block, const Floats& alpha, Doubles& residual, Doubles& product);

    /// x += alpha p, z = L⁻ᵀ D⁻¹ z, p = z + beta p, q = A p; the sum is p·q of each coordinate.
    void (*backward)(const Block& block, const Floats& alpha, const Floats& beta, Doubles& product);
};

/// The best that this processor can run; if the environment variable TRACKED_MCF_INSTRUCTIONS is
/// "baseline", those that every one can.
const CotangentKernels& cotangent_kernels();

}  // namespace tracked_mcf::benchmark
