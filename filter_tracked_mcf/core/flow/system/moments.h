// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "filter_tracked_mcf/core/flow/cells/bspline.h"
#include "filter_tracked_mcf/core/flow/elements/tracked_elements.h"

// The integrals over the samples of one element. Loops work on four samples at a time.

namespace tracked_mcf {

/// A sample has collapsed if its deformed area is at most this fraction of its initial area. The
/// surface there has become a thread or a point, and its metric means nothing. A collapsed sample
/// contributes nothing (section 5.1).
inline constexpr float kCollapsedAreaRatio = 1e-4F;

/// Four floats, one for each of four samples or elements. Every x86-64 and ARM64 processor has such
/// vectors.
using Lanes = Eigen::Array4f;
inline constexpr int kLanes = 4;

/// Number of samples per chunk, small enough for the first-level cache.
inline constexpr int kChunk = 128;

/// A number for each sample of a chunk; a column for each four.
using Row = Eigen::Array<float, kLanes, kChunk / kLanes>;

/// Some samples of one element, one row for each quantity. The last column is padded with samples
/// of weight 0, which add nothing to any integral.
struct SampleChunk {
    Row normal[3];     ///< of the initial surface
    Row weight;        ///< w: area on the initial surface, grid units²
    Row linear[6];     ///< 1-x and x; the same for y and z
    Row bernstein[9];  ///< (1-x)², x(1-x), x²; the same for y and z
    Row area;          ///< w √|g|, grid units²; 0 if collapsed
    Row tensor[6];     ///< G = w √|g| T g⁻¹ Tᵀ: xx, yy, zz, xy, yz, zx; 0 if collapsed
    Row flux[3][3];    ///< G ∇X_t for each coordinate of X_t; 0 if collapsed
    int count;         ///< of samples
    int columns;       ///< of the rows
};

struct LaneVector {
    Lanes x, y, z;
};
inline Lanes dot(const LaneVector& a, const LaneVector& b) {
    return a.z * b.z + (a.x * b.x + a.y * b.y);
}
inline LaneVector cross(const LaneVector& a, const LaneVector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// One coordinate of a trilinear map, as a polynomial of the local coordinates without its constant
/// term.
struct Trilinear {
    float x, y, z, xy, yz, xz, xyz;
};
/// Returns the polynomial with these values at the corners of the cell.
inline Trilinear trilinear(const float (&c)[8]) {
    const float x = c[1] - c[0], y = c[2] - c[0], z = c[4] - c[0], xy = c[3] - c[2] - x;
    return {x, y, z, xy, c[6] - c[4] - y, c[5] - c[4] - x, c[7] - c[6] - c[5] + c[4] - xy};
}
inline LaneVector gradient(const Trilinear& p, const LaneVector& at) {
    const Lanes xz = p.xyz * at.y + p.xz;
    const Lanes yz = p.xyz * at.x + p.yz;
    return {xz * at.z + (p.xy * at.y + p.x), yz * at.z + (p.xy * at.x + p.y),
            yz * at.y + (p.xz * at.x + p.z)};
}

/// The embedding X_t in the element's cell, up to a constant.
struct Embedding {
    Trilinear x, y, z;
};

/// The vectors from which the metric follows. J_i are the rows of the embedding's derivative.
struct Differential {
    LaneVector kx, ky, kz;  ///< n × J_i
    LaneVector normal;      ///< -cof(J) n: normal to X_t, of length √|g|
};
inline Differential differential(const Embedding& x, const LaneVector& at, const LaneVector& n) {
    const LaneVector jx = gradient(x.x, at), jy = gradient(x.y, at), jz = gradient(x.z, at);
    Differential d;
    d.kx = cross(n, jx);
    d.ky = cross(n, jy);
    d.kz = cross(n, jz);
    d.normal.x = dot(jy, d.kz);
    d.normal.y = dot(jz, d.kx);
    d.normal.z = dot(jx, d.ky);
    return d;
}

/// Computes the tensor G of the present metric. The paper has √|g| T g⁻¹ Tᵀ with a basis T of the
/// tangents. This equals Σ_i (n × J_i) (n × J_i)ᵀ / √|g|, because the rotation of T by a right
/// angle turns g into its adjugate. The sum needs no basis, and its entries for directions close to
/// the normal are small without cancellation.
inline void set_tensor(const Differential& d, const Lanes& scale, SampleChunk& chunk, int column) {
    const LaneVector x = {d.kx.x, d.ky.x, d.kz.x};
    const LaneVector y = {d.kx.y, d.ky.y, d.kz.y};
    const LaneVector z = {d.kx.z, d.ky.z, d.kz.z};
    chunk.tensor[0].col(column) = scale * dot(x, x);
    chunk.tensor[1].col(column) = scale * dot(y, y);
    chunk.tensor[2].col(column) = scale * dot(z, z);
    chunk.tensor[3].col(column) = scale * dot(x, y);
    chunk.tensor[4].col(column) = scale * dot(y, z);
    chunk.tensor[5].col(column) = scale * dot(z, x);
}

/// Computes the fluxes G J_a = Σ_i (n × J_i) (n × J_i) · J_a / √|g|. The factors (n × J_i) · J_a
/// are 0 or, up to sign, coordinates of the normal. Multiplying G by J_a instead would cancel where
/// the surface is compressed.
inline void set_flux(const Differential& d, const Lanes& scale, SampleChunk& chunk, int column) {
    const LaneVector n = {scale * d.normal.x, scale * d.normal.y, scale * d.normal.z};
    const auto set_difference = [&](const LaneVector& a, const Lanes& s, const LaneVector& b,
                                    const Lanes& t, Row(&flux)[3]) {
        flux[0].col(column) = s * a.x - t * b.x;
        flux[1].col(column) = s * a.y - t * b.y;
        flux[2].col(column) = s * a.z - t * b.z;
    };
    set_difference(d.ky, n.z, d.kz, n.y, chunk.flux[0]);
    set_difference(d.kz, n.x, d.kx, n.z, chunk.flux[1]);
    set_difference(d.kx, n.y, d.ky, n.x, chunk.flux[2]);
}

/// Computes the functions of one axis. Both x and 1-x are rounded from the exact number of steps,
/// because one of them is small for functions that hardly meet the surface.
inline void set_functions(std::int32_t steps, int axis, SampleChunk& chunk, int i) {
    constexpr float step = 1.0F / kSampleSteps;
    const float x = static_cast<float>(steps) * step,
                rest = static_cast<float>(kSampleSteps - steps) * step;
    chunk.linear[2 * axis](i) = rest;
    chunk.linear[2 * axis + 1](i) = x;
    chunk.bernstein[3 * axis](i) = rest * rest;
    chunk.bernstein[3 * axis + 1](i) = x * rest;
    chunk.bernstein[3 * axis + 2](i) = x * x;
}

/// Computes all rows of a chunk that follow from the samples.
inline void evaluate(const Embedding& x, SampleChunk& chunk) {
    for (int column = 0; column < chunk.columns; ++column) {
        const LaneVector at = {chunk.linear[1].col(column), chunk.linear[3].col(column),
                               chunk.linear[5].col(column)};
        const LaneVector n = {chunk.normal[0].col(column), chunk.normal[1].col(column),
                              chunk.normal[2].col(column)};
        const Differential d = differential(x, at, n);
        const Lanes square = dot(d.normal, d.normal);
        const Lanes weight = chunk.weight.col(column);
        Lanes weighted, scale;
        // Lane by lane: Eigen's roots of vectors are approximations that depend on the processor.
        for (int lane = 0; lane < kLanes; ++lane) {
            const float area = std::sqrt(square[lane]);
            const bool is_sound = area > kCollapsedAreaRatio;
            weighted[lane] = is_sound ? weight[lane] * area : 0;
            scale[lane] = is_sound ? weight[lane] / area : 0;
        }
        chunk.area.col(column) = weighted;
        set_tensor(d, scale, chunk, column);
        set_flux(d, scale, chunk, column);
    }
}

/// Moments: integrals from which the element matrices follow. A product of two of a cell's
/// functions is a product of three quadratic Bernstein polynomials bx_i by_j bz_k, one for each
/// axis: (1-x)², x(1-x) or x². Each sample adds to 27 moments for the mass, 63 for the stiffness
/// and 36 for the right-hand side; the matrices are expanded from these sums once per element. All
/// polynomials are positive, so moments add no cancellation.
///
/// lx_0 = 1-x and lx_1 = x are the linear functions of x. F_a = G ∇X_t is the flux of the
/// embedding's coordinate a. Each constant is the offset of the first moment of its kind.
inline constexpr int kMass = 0;     ///< [i][j][k]: ∫ bx_i by_j bz_k
inline constexpr int kXX = 27;      ///< [j][k]: ∫ G_xx by_j bz_k
inline constexpr int kYY = 36;      ///< [k][i]: ∫ G_yy bz_k bx_i
inline constexpr int kZZ = 45;      ///< [i][j]: ∫ G_zz bx_i by_j
inline constexpr int kXY = 54;      ///< [i][j][k]: ∫ G_xy lx_i ly_j bz_k
inline constexpr int kYZ = 66;      ///< [j][k][i]: ∫ G_yz ly_j lz_k bx_i
inline constexpr int kZX = 78;      ///< [k][i][j]: ∫ G_zx lz_k lx_i by_j
inline constexpr int kFluxX = 90;   ///< [a][j][k]: ∫ F_a,x ly_j lz_k
inline constexpr int kFluxY = 102;  ///< [a][k][i]: ∫ F_a,y lz_k lx_i
inline constexpr int kFluxZ = 114;  ///< [a][i][j]: ∫ F_a,z lx_i ly_j
inline constexpr int kMoments = 126;

/// kMoments rounded up to a multiple of kLanes.
inline constexpr int kMomentRows = 128;
using Moments = Eigen::Array<float, kMomentRows, 1>;

/// Sums the moments [j][k] of a factor and the quadratic polynomials of two axes.
template <class Factor>
void sum_quadratic(const SampleChunk& chunk, const Factor& factor, int b, int c, Lanes* moments) {
    Lanes sum[9];
    std::fill_n(sum, 9, Lanes::Zero());
    for (int s = 0; s < chunk.columns; ++s) {
        const Lanes t = factor(s);
        for (int j = 0; j < 3; ++j) {
            const Lanes ty = t * chunk.bernstein[3 * b + j].col(s);
            for (int k = 0; k < 3; ++k) sum[3 * j + k] += ty * chunk.bernstein[3 * c + k].col(s);
        }
    }
    std::copy_n(sum, 9, moments);
}

/// Sums the moments [i][j][k] of an off-diagonal entry: ∫ G_ab la_i lb_j bc_k.
inline void sum_mixed(const SampleChunk& chunk, const Row& tensor, int a, int b, int c,
                      Lanes* moments) {
    Lanes sum[12];
    std::fill_n(sum, 12, Lanes::Zero());
    for (int s = 0; s < chunk.columns; ++s) {
        const Lanes t0 = tensor.col(s) * chunk.linear[2 * a].col(s);
        const Lanes t1 = tensor.col(s) * chunk.linear[2 * a + 1].col(s);
        const Lanes y0 = chunk.linear[2 * b].col(s), y1 = chunk.linear[2 * b + 1].col(s);
        const Lanes products[4] = {t0 * y0, t0 * y1, t1 * y0, t1 * y1};
        for (int k = 0; k < 3; ++k) {
            const Lanes z = chunk.bernstein[3 * c + k].col(s);
            for (int p = 0; p < 4; ++p) sum[3 * p + k] += products[p] * z;
        }
    }
    std::copy_n(sum, 12, moments);
}

/// Sums the moments [a][j][k] of the fluxes along one axis: ∫ F_a lb_j lc_k.
inline void sum_flux(const SampleChunk& chunk, int along, int b, int c, Lanes* moments) {
    Lanes sum[12];
    std::fill_n(sum, 12, Lanes::Zero());
    for (int s = 0; s < chunk.columns; ++s) {
        const Lanes y0 = chunk.linear[2 * b].col(s), y1 = chunk.linear[2 * b + 1].col(s);
        const Lanes z0 = chunk.linear[2 * c].col(s), z1 = chunk.linear[2 * c + 1].col(s);
        const Lanes products[4] = {y0 * z0, y0 * z1, y1 * z0, y1 * z1};
        for (int axis = 0; axis < 3; ++axis) {
            const Lanes flux = chunk.flux[axis][along].col(s);
            for (int p = 0; p < 4; ++p) sum[4 * axis + p] += flux * products[p];
        }
    }
    std::copy_n(sum, 12, moments);
}

/// Adds the moments of a chunk's samples to the sums.
inline void add_moments(const SampleChunk& chunk, Moments& sums) {
    Lanes lanes[kMomentRows];
    std::fill(lanes + kMoments, lanes + kMomentRows, Lanes::Zero());
    for (int i = 0; i < 3; ++i) {
        const auto factor = [&](int s) { return chunk.bernstein[i].col(s) * chunk.area.col(s); };
        sum_quadratic(chunk, factor, 1, 2, lanes + kMass + 9 * i);
    }
    constexpr int offsets[3] = {kXX, kYY, kZZ};
    for (int a = 0; a < 3; ++a) {
        const auto factor = [&](int s) { return chunk.tensor[a].col(s); };
        sum_quadratic(chunk, factor, (a + 1) % 3, (a + 2) % 3, lanes + offsets[a]);
    }
    sum_mixed(chunk, chunk.tensor[3], 0, 1, 2, lanes + kXY);
    sum_mixed(chunk, chunk.tensor[4], 1, 2, 0, lanes + kYZ);
    sum_mixed(chunk, chunk.tensor[5], 2, 0, 1, lanes + kZX);
    sum_flux(chunk, 0, 1, 2, lanes + kFluxX);
    sum_flux(chunk, 1, 2, 0, lanes + kFluxY);
    sum_flux(chunk, 2, 0, 1, lanes + kFluxZ);
    for (int m = 0; m < kMomentRows; m += kLanes) {
        Eigen::Array44f square;
        for (int i = 0; i < kLanes; ++i) square.row(i) = lanes[m + i];
        sums.segment<kLanes>(m) +=
            (square.col(0) + square.col(1)) + (square.col(2) + square.col(3));
    }
}

/// Returns the embedding of an element's cell. Differences are taken in double precision.
inline Embedding embedding_of(const TrackedElements& elements, const Coefficients& displacement,
                              std::int64_t element) {
    const auto& unknowns = elements.finest().unknowns[element];
    float corners[3][8];
    for (int axis = 0; axis < 3; ++axis) {
        const double base = displacement(unknowns[0], axis);
        const double origin[2] = {base, base - 1};
        for (int corner = 0; corner < 8; ++corner) {
            corners[axis][corner] = static_cast<float>(displacement(unknowns[corner], axis) -
                                                       origin[corner_bit(corner, axis)]);
        }
    }
    return {trilinear(corners[0]), trilinear(corners[1]), trilinear(corners[2])};
}

/// Adds the moments of an element, and returns the number of its collapsed samples.
inline std::int64_t add_moments(const TrackedElements& elements, const Coefficients& displacement,
                                std::int64_t element, Moments& moments) {
    const Embedding embedding = embedding_of(elements, displacement, element);
    const Fragment* fragment = elements.fragments.data() + elements.fragment_begin[element];
    std::int32_t used = 0;  // samples of this fragment
    std::int64_t collapsed = 0;
    SampleChunk chunk;
    const std::int64_t end = elements.sample_begin[element + 1];
    for (std::int64_t first = elements.sample_begin[element]; first < end; first += chunk.count) {
        chunk.count = static_cast<int>(std::min<std::int64_t>(kChunk, end - first));
        chunk.columns = (chunk.count + kLanes - 1) / kLanes;
        for (int i = 0; i < chunk.count; ++i, ++used) {
            for (; used == fragment->sample_count; used = 0) ++fragment;
            for (int axis = 0; axis < 3; ++axis) chunk.normal[axis](i) = fragment->normal[axis];
            chunk.weight(i) = elements.samples.weight(first + i);
        }
        for (int i = 0; i < chunk.count; ++i) {
            for (int axis = 0; axis < 3; ++axis)
                set_functions(elements.samples.steps(first + i, axis), axis, chunk, i);
        }
        for (int i = chunk.count; i < kLanes * chunk.columns; ++i) {
            chunk.weight(i) = 0;
            for (int axis = 0; axis < 3; ++axis) {
                chunk.normal[axis](i) = 0;
                set_functions(0, axis, chunk, i);
            }
        }
        evaluate(embedding, chunk);
        for (int i = 0; i < chunk.count; ++i)
            collapsed += chunk.area(i) <= 0 && chunk.weight(i) > 0 ? 1 : 0;
        add_moments(chunk, moments);
    }
    return collapsed;
}

}  // namespace tracked_mcf
