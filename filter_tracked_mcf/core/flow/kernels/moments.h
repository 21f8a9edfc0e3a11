// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/flow/kernels/sample_chunk.h"

namespace tracked_mcf::kernels {

/// Moments: integrals from which the element matrices follow. A product of two of a cell's
/// functions is a product of three quadratic Bernstein polynomials bx_i by_j bz_k, one for each
/// axis: (1-x)², x(1-x) or x². For each sample, the kernel adds to 27 moments for the mass, 63 for
/// the stiffness and 36 for the right-hand side; it expands the matrices from these sums once per
/// element. All polynomials are positive, so moments add no cancellation.
///
/// lx_0 = 1-x and lx_1 = x are the linear functions of x. F_a = G ∇X_t is the flux of the
/// embedding's coordinate a. Each constant is the offset of the first moment of its kind.
constexpr int kMass = 0;     ///< [i][j][k]: ∫ bx_i by_j bz_k
constexpr int kXX = 27;      ///< [j][k]: ∫ G_xx by_j bz_k
constexpr int kYY = 36;      ///< [k][i]: ∫ G_yy bz_k bx_i
constexpr int kZZ = 45;      ///< [i][j]: ∫ G_zz bx_i by_j
constexpr int kXY = 54;      ///< [i][j][k]: ∫ G_xy lx_i ly_j bz_k
constexpr int kYZ = 66;      ///< [j][k][i]: ∫ G_yz ly_j lz_k bx_i
constexpr int kZX = 78;      ///< [k][i][j]: ∫ G_zx lz_k lx_i by_j
constexpr int kFluxX = 90;   ///< [a][j][k]: ∫ F_a,x ly_j lz_k
constexpr int kFluxY = 102;  ///< [a][k][i]: ∫ F_a,y lz_k lx_i
constexpr int kFluxZ = 114;  ///< [a][i][j]: ∫ F_a,z lx_i ly_j
constexpr int kMoments = 126;

/// kMoments rounded up to a multiple of kLanes.
constexpr int kMomentRows = (kMoments + kLanes - 1) / kLanes * kLanes;

/// Sums the mass moments [j][k] of one i.
inline void mass_moments(const SampleChunk& chunk, int i, Lanes* moments) {
    Lanes sum[9];
    set_zero(sum);
    for (int s = 0; s < chunk.count; s += kLanes) {
        const Lanes x = load(chunk.bernstein[i] + s) * load(chunk.area + s);
        for (int j = 0; j < 3; ++j) {
            const Lanes xy = x * load(chunk.bernstein[3 + j] + s);
            for (int k = 0; k < 3; ++k) {
                sum[3 * j + k] += xy * load(chunk.bernstein[6 + k] + s);
            }
        }
    }
    for (int m = 0; m < 9; ++m) moments[m] = sum[m];
}

/// Sums the moments [j][k] of a diagonal entry: ∫ G_aa bb_j bc_k, where b is `axis`, c `other`.
inline void diagonal_moments(const SampleChunk& chunk, const Row& tensor, int axis, int other,
                             Lanes* moments) {
    Lanes sum[9];
    set_zero(sum);
    for (int s = 0; s < chunk.count; s += kLanes) {
        const Lanes t = load(tensor + s);
        for (int j = 0; j < 3; ++j) {
            const Lanes ty = t * load(chunk.bernstein[3 * axis + j] + s);
            for (int k = 0; k < 3; ++k) {
                const Lanes z = load(chunk.bernstein[3 * other + k] + s);
                sum[3 * j + k] += ty * z;
            }
        }
    }
    for (int m = 0; m < 9; ++m) moments[m] = sum[m];
}

/// Sums the moments [i][j][k] of an off-diagonal entry: ∫ G_ab la_i lb_j bc_k, where c is `third`.
inline void mixed_moments(const SampleChunk& chunk, const Row& tensor, int a, int b, int third,
                          Lanes* moments) {
    Lanes sum[12];
    set_zero(sum);
    for (int s = 0; s < chunk.count; s += kLanes) {
        const Lanes t = load(tensor + s);
        const Lanes t0 = t * load(chunk.linear[2 * a] + s);
        const Lanes t1 = t * load(chunk.linear[2 * a + 1] + s);
        const Lanes y0 = load(chunk.linear[2 * b] + s);
        const Lanes y1 = load(chunk.linear[2 * b + 1] + s);
        const Lanes products[4] = {t0 * y0, t0 * y1, t1 * y0, t1 * y1};
        for (int k = 0; k < 3; ++k) {
            const Lanes z = load(chunk.bernstein[3 * third + k] + s);
            for (int p = 0; p < 4; ++p) {
                sum[3 * p + k] += products[p] * z;
            }
        }
    }
    for (int m = 0; m < 12; ++m) moments[m] = sum[m];
}

/// Sums the moments [a][j][k] of the fluxes along one axis: ∫ F_a lb_j lc_k.
inline void flux_moments(const SampleChunk& chunk, int along, int b, int c, Lanes* moments) {
    Lanes sum[12];
    set_zero(sum);
    for (int s = 0; s < chunk.count; s += kLanes) {
        const Lanes y0 = load(chunk.linear[2 * b] + s);
        const Lanes y1 = load(chunk.linear[2 * b + 1] + s);
        const Lanes z0 = load(chunk.linear[2 * c] + s);
        const Lanes z1 = load(chunk.linear[2 * c + 1] + s);
        const Lanes products[4] = {y0 * z0, y0 * z1, y1 * z0, y1 * z1};
        for (int axis = 0; axis < 3; ++axis) {
            const Lanes flux = load(chunk.flux[axis][along] + s);
            for (int p = 0; p < 4; ++p) {
                sum[4 * axis + p] += flux * products[p];
            }
        }
    }
    for (int m = 0; m < 12; ++m) moments[m] = sum[m];
}

/// Adds the moments of a chunk's samples to the sums.
inline void add_moments(const SampleChunk& chunk, float (&sums)[kMomentRows]) {
    Lanes lanes[kMomentRows];
    for (int m = kMoments; m < kMomentRows; ++m) lanes[m] = zero();
    for (int i = 0; i < 3; ++i) mass_moments(chunk, i, lanes + kMass + 9 * i);
    diagonal_moments(chunk, chunk.tensor[0], 1, 2, lanes + kXX);
    diagonal_moments(chunk, chunk.tensor[1], 2, 0, lanes + kYY);
    diagonal_moments(chunk, chunk.tensor[2], 0, 1, lanes + kZZ);
    mixed_moments(chunk, chunk.tensor[3], 0, 1, 2, lanes + kXY);
    mixed_moments(chunk, chunk.tensor[4], 1, 2, 0, lanes + kYZ);
    mixed_moments(chunk, chunk.tensor[5], 2, 0, 1, lanes + kZX);
    flux_moments(chunk, 0, 1, 2, lanes + kFluxX);
    flux_moments(chunk, 1, 2, 0, lanes + kFluxY);
    flux_moments(chunk, 2, 0, 1, lanes + kFluxZ);
    for (int m = 0; m < kMomentRows; m += kLanes) {
        store(load(sums + m) + sums_of_lanes(lanes + m), sums + m);
    }
}

}  // namespace tracked_mcf::kernels
