#pragma once

#include "filter_tracked_mcf/core/kernels/sample_chunk.h"

// For integrate_elements.cpp alone, see lanes.h.

namespace tracked_mcf::TRACKED_MCF_KERNELS {

/// Integrals from which element matrices are made. A product of two of a cell's functions is a
/// product of three quadratic Bernstein polynomials bx_i by_j bz_k, one for each axis: (1-x)²,
/// x(1-x) or x². So instead of 36 + 36 products of functions, 27 + 63 moments are summed, all lanes
/// of samples at a time, and 36 for the right side. All polynomials are positive, so nothing
/// cancels that would not in the matrices. Here is where each kind begins, and how it is numbered.
constexpr int kMass = 0;     ///< [i][j][k]: ∫ bx_i by_j bz_k
constexpr int kXX = 27;      ///< [j][k]: ∫ G_xx by_j bz_k
constexpr int kYY = 36;      ///< [k][i]: ∫ G_yy bz_k bx_i
constexpr int kZZ = 45;      ///< [i][j]: ∫ G_zz bx_i by_j
constexpr int kXY = 54;      ///< [x][y][k]: ∫ G_xy of the linear functions of x and y, and bz_k
constexpr int kYZ = 66;      ///< [y][z][i]
constexpr int kZX = 78;      ///< [z][x][j]
constexpr int kPullX = 90;   ///< [axis][y][z]: ∫ of the pull along x and the linear functions
constexpr int kPullY = 102;  ///< [axis][z][x]
constexpr int kPullZ = 114;  ///< [axis][x][y]
constexpr int kMoments = 126;

/// Rounded up to whole variables.
constexpr int kMomentRows = (kMoments + kLanes - 1) / kLanes * kLanes;

/// [j][k] for one i.
TRACKED_MCF_INLINE void mass_moments(const SampleChunk& chunk, int i, Lanes* moments) {
    Lanes sum[9] = {};
    for (int s = 0; s < chunk.count; s += kLanes) {
        const Lanes x = load(chunk.bernstein[i] + s) * load(chunk.area + s);
        for (int j = 0; j < 3; ++j) {
            const Lanes xy = x * load(chunk.bernstein[3 + j] + s);
            for (int k = 0; k < 3; ++k) sum[3 * j + k] += xy * load(chunk.bernstein[6 + k] + s);
        }
    }
    for (int m = 0; m < 9; ++m) moments[m] = sum[m];
}

/// [j][k] of a diagonal entry of the tensor and two axes.
TRACKED_MCF_INLINE void diagonal_moments(const SampleChunk& chunk, const Row& tensor, int axis,
                                         int other, Lanes* moments) {
    Lanes sum[9] = {};
    for (int s = 0; s < chunk.count; s += kLanes) {
        const Lanes t = load(tensor + s);
        for (int j = 0; j < 3; ++j) {
            const Lanes ty = t * load(chunk.bernstein[3 * axis + j] + s);
            for (int k = 0; k < 3; ++k) {
                sum[3 * j + k] += ty * load(chunk.bernstein[3 * other + k] + s);
            }
        }
    }
    for (int m = 0; m < 9; ++m) moments[m] = sum[m];
}

/// [a][b][k] of an entry beside the diagonal, its two axes, and the third.
TRACKED_MCF_INLINE void mixed_moments(const SampleChunk& chunk, const Row& tensor, int a, int b,
                                      int third, Lanes* moments) {
    Lanes sum[12] = {};
    for (int s = 0; s < chunk.count; s += kLanes) {
        const Lanes t = load(tensor + s);
        const Lanes t0 = t * load(chunk.linear[2 * a] + s);
        const Lanes t1 = t * load(chunk.linear[2 * a + 1] + s);
        const Lanes y0 = load(chunk.linear[2 * b] + s);
        const Lanes y1 = load(chunk.linear[2 * b + 1] + s);
        const Lanes products[4] = {t0 * y0, t0 * y1, t1 * y0, t1 * y1};
        for (int k = 0; k < 3; ++k) {
            const Lanes z = load(chunk.bernstein[3 * third + k] + s);
            for (int p = 0; p < 4; ++p) sum[3 * p + k] += products[p] * z;
        }
    }
    for (int m = 0; m < 12; ++m) moments[m] = sum[m];
}

/// [axis][b][c] of the pull along one axis, and the other two.
TRACKED_MCF_INLINE void pull_moments(const SampleChunk& chunk, int along, int b, int c,
                                     Lanes* moments) {
    Lanes sum[12] = {};
    for (int s = 0; s < chunk.count; s += kLanes) {
        const Lanes y0 = load(chunk.linear[2 * b] + s);
        const Lanes y1 = load(chunk.linear[2 * b + 1] + s);
        const Lanes z0 = load(chunk.linear[2 * c] + s);
        const Lanes z1 = load(chunk.linear[2 * c + 1] + s);
        const Lanes products[4] = {y0 * z0, y0 * z1, y1 * z0, y1 * z1};
        for (int axis = 0; axis < 3; ++axis) {
            const Lanes pull = load(chunk.pull[axis][along] + s);
            for (int p = 0; p < 4; ++p) sum[4 * axis + p] += pull * products[p];
        }
    }
    for (int m = 0; m < 12; ++m) moments[m] = sum[m];
}

TRACKED_MCF_INLINE void add_moments(const SampleChunk& chunk, float (&sums)[kMomentRows]) {
    Lanes lanes[kMomentRows];
    for (int m = kMoments; m < kMomentRows; ++m) lanes[m] = Lanes{};
    for (int i = 0; i < 3; ++i) mass_moments(chunk, i, lanes + kMass + 9 * i);
    diagonal_moments(chunk, chunk.tensor[0], 1, 2, lanes + kXX);
    diagonal_moments(chunk, chunk.tensor[1], 2, 0, lanes + kYY);
    diagonal_moments(chunk, chunk.tensor[2], 0, 1, lanes + kZZ);
    mixed_moments(chunk, chunk.tensor[3], 0, 1, 2, lanes + kXY);
    mixed_moments(chunk, chunk.tensor[4], 1, 2, 0, lanes + kYZ);
    mixed_moments(chunk, chunk.tensor[5], 2, 0, 1, lanes + kZX);
    pull_moments(chunk, 0, 1, 2, lanes + kPullX);
    pull_moments(chunk, 1, 2, 0, lanes + kPullY);
    pull_moments(chunk, 2, 0, 1, lanes + kPullZ);
    for (int m = 0; m < kMomentRows; m += kLanes) {
        store(load(sums + m) + sums_of_lanes<kLanes>(lanes + m), sums + m);
    }
}

}  // namespace tracked_mcf::TRACKED_MCF_KERNELS
