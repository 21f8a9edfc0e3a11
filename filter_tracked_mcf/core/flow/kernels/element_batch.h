// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstring>

#include "filter_tracked_mcf/core/flow/kernels/moments.h"

namespace tracked_mcf::kernels {

constexpr int kCoefficients = 7;

/// One element for each lane.
struct ElementBatch {
    alignas(64) float moments[kLanes][kMomentRows];
    /// The embedding's coordinates at the cell's corners, relative to corner 0.
    alignas(64) float corners[3][8][kLanes];
    /// The embedding's coordinates as polynomials: the coefficients of a Trilinear.
    alignas(64) float polynomials[3][kCoefficients][kLanes];
};

constexpr int bit(int corner, int axis) {
    return (corner >> axis) & 1;
}

/// Sets one element's corners. Differences are taken in double precision.
inline void read_corners(const IntegrationInput& input, std::int64_t element, int lane,
                         ElementBatch& batch) {
    const std::int32_t* const unknowns = input.unknowns + 8 * element;
    const double* const base = input.displacement + std::int64_t{3} * unknowns[0];
    const double origin[3][2] = {
        {base[0], base[0] - 1}, {base[1], base[1] - 1}, {base[2], base[2] - 1}};
    for (int corner = 0; corner < 8; ++corner) {
        const double* const u = input.displacement + std::int64_t{3} * unknowns[corner];
        for (int axis = 0; axis < 3; ++axis) {
            batch.corners[axis][corner][lane] =
                static_cast<float>(u[axis] - origin[axis][bit(corner, axis)]);
        }
    }
}

/// Computes the polynomials of all elements from their corners.
inline void find_polynomials(ElementBatch& batch) {
    for (int axis = 0; axis < 3; ++axis) {
        Lanes c[8];
        for (int corner = 0; corner < 8; ++corner) c[corner] = load(batch.corners[axis][corner]);
        const Lanes x = c[1] - c[0];
        const Lanes y = c[2] - c[0];
        const Lanes z = c[4] - c[0];
        const Lanes xy = c[3] - c[2] - x;
        const Lanes coefficients[kCoefficients] = {
            x, y, z, xy, c[6] - c[4] - y, c[5] - c[4] - x, c[7] - c[6] - c[5] + c[4] - xy};
        for (int i = 0; i < kCoefficients; ++i) store(coefficients[i], batch.polynomials[axis][i]);
    }
}

inline void read_embedding(const IntegrationInput& input, std::int64_t begin, int count,
                           ElementBatch& batch) {
    for (int lane = 0; lane < count; ++lane) read_corners(input, begin + lane, lane, batch);
    find_polynomials(batch);
}

inline Trilinear trilinear(const float (&p)[kCoefficients][kLanes], int lane) {
    return {p[0][lane], p[1][lane], p[2][lane], p[3][lane], p[4][lane], p[5][lane], p[6][lane]};
}
inline Embedding embedding_of(const ElementBatch& batch, int lane) {
    return {trilinear(batch.polynomials[0], lane), trilinear(batch.polynomials[1], lane),
            trilinear(batch.polynomials[2], lane)};
}

/// Adds x or subtracts it. The sign is a product of slopes, which are 1 or -1.
inline void add_signed(Lanes& sum, bool positive, const Lanes& x) {
    if (positive) {
        sum += x;
    } else {
        sum -= x;
    }
}

/// Returns ∫ ∇B_I · G ∇B_J, a sum of moments. ∂B_I/∂x is a slope times the linear functions of y
/// and z in B_I; these linear functions choose the moment.
inline Lanes stiffness_entry(const Lanes (&moments)[kMomentRows], int row, int column) {
    const int xi = bit(row, 0), yi = bit(row, 1), zi = bit(row, 2);
    const int xj = bit(column, 0), yj = bit(column, 1), zj = bit(column, 2);
    Lanes sum = zero();
    add_signed(sum, xi == xj, moments[kXX + 3 * (yi + yj) + zi + zj]);
    add_signed(sum, yi == yj, moments[kYY + 3 * (zi + zj) + xi + xj]);
    add_signed(sum, zi == zj, moments[kZZ + 3 * (xi + xj) + yi + yj]);
    add_signed(sum, xi == yj, moments[kXY + 6 * xj + 3 * yi + zi + zj]);
    add_signed(sum, yi == xj, moments[kXY + 6 * xi + 3 * yj + zi + zj]);
    add_signed(sum, yi == zj, moments[kYZ + 6 * yj + 3 * zi + xi + xj]);
    add_signed(sum, zi == yj, moments[kYZ + 6 * yi + 3 * zj + xi + xj]);
    add_signed(sum, zi == xj, moments[kZX + 6 * zj + 3 * xi + yi + yj]);
    add_signed(sum, xi == zj, moments[kZX + 6 * zi + 3 * xj + yi + yj]);
    return sum;
}

inline Lanes mass_entry(const Lanes (&moments)[kMomentRows], int row, int column) {
    return moments[kMass + 9 * (bit(row, 0) + bit(column, 0)) + 3 * (bit(row, 1) + bit(column, 1)) +
                   bit(row, 2) + bit(column, 2)];
}

/// Returns ∫ ∇B_I · G ∇X_t for one coordinate of X_t.
inline Lanes flux_entry(const Lanes (&moments)[kMomentRows], int axis, int row) {
    const int x = bit(row, 0), y = bit(row, 1), z = bit(row, 2);
    Lanes sum = zero();
    add_signed(sum, x == 1, moments[kFluxX + 4 * axis + 2 * y + z]);
    add_signed(sum, y == 1, moments[kFluxY + 4 * axis + 2 * z + x]);
    add_signed(sum, z == 1, moments[kFluxZ + 4 * axis + 2 * x + y]);
    return sum;
}

/// Returns the area in the metric of the mass: the sum of ∫ B_I B_J over all I and J, because the
/// functions B sum to 1.
inline Lanes area_of_mass(const Lanes (&moments)[kMomentRows]) {
    Lanes area = zero();
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const Lanes* const m = moments + kMass + 9 * i + 3 * j;
            const auto products = static_cast<float>((1 + i % 2) * (1 + j % 2));
            area += splat(products) * (splat(2) * m[1] + m[0] + m[2]);
        }
    }
    return area;
}

/// Writes the matrices of the batch into a block, from this lane of the block on.
inline void write_matrices(const IntegrationInput& input, const Lanes& mass,
                           const Lanes (&moments)[kMomentRows], MatrixBlock& block,
                           std::int64_t lane) {
    const Lanes step_size = splat(input.step_size_in_squared_cells);
    for (int row = 0; row < 8; ++row) {
        for (int column = row; column < 8; ++column) {
            float* const entry = block.entry[kEntryIndices.of[row][column]] + lane;
            const Lanes weighted_mass = mass * mass_entry(moments, row, column);
            store(step_size * stiffness_entry(moments, row, column) + weighted_mass, entry);
        }
    }
}

/// Offsets of the other results of an element.
constexpr int kRightSide = 0;
constexpr int kArea = 24;
constexpr int kResults = 32;  ///< rounded up to a multiple of kLanes

inline void find_results(const IntegrationInput& input, const Lanes (&moments)[kMomentRows],
                         Lanes (&results)[kResults]) {
    for (int axis = 0; axis < 3; ++axis) {
        for (int row = 0; row < 8; ++row) {
            results[kRightSide + 8 * axis + row] =
                splat(-input.step_size_in_squared_cells) * flux_entry(moments, axis, row);
        }
    }
    results[kArea] = area_of_mass(moments);
    for (int i = kArea + 1; i < kResults; ++i) results[i] = zero();
}

/// Transposes the moments: from one row for each element to one lane for each element.
inline void transpose_moments(const ElementBatch& batch, Lanes (&moments)[kMomentRows]) {
    for (int m = 0; m < kMomentRows; m += kLanes) {
        Lanes block[kLanes];
        for (int lane = 0; lane < kLanes; ++lane) block[lane] = load(batch.moments[lane] + m);
        transpose(block);
        for (int i = 0; i < kLanes; ++i) moments[m + i] = block[i];
    }
}

inline void write_systems(const IntegrationInput& input, std::int64_t begin, int count,
                          const ElementBatch& batch, const IntegrationOutput& output) {
    Lanes moments[kMomentRows];
    transpose_moments(batch, moments);
    const std::int64_t block = begin / kBlockElements;
    const std::int64_t lane = begin % kBlockElements;
    write_matrices(input, splat(1), moments, output.matrices[block], lane);
    if (output.stiffnesses != nullptr) {
        write_matrices(input, zero(), moments, output.stiffnesses[block], lane);
    }
    Lanes results[kResults];
    find_results(input, moments, results);
    alignas(64) float rows[kLanes][kResults];
    for (int r = 0; r < kResults; r += kLanes) {
        Lanes square[kLanes];
        for (int i = 0; i < kLanes; ++i) square[i] = results[r + i];
        transpose(square);
        for (int i = 0; i < kLanes; ++i) store(square[i], rows[i] + r);
    }
    for (int i = 0; i < count; ++i) {
        std::memcpy(output.right_sides + begin + i, rows[i] + kRightSide, sizeof(ElementVector));
        output.areas[begin + i] = rows[i][kArea];
    }
}

}  // namespace tracked_mcf::kernels
