// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>

#include "filter_tracked_mcf/core/flow/kernels/integrate_elements.h"
#include "filter_tracked_mcf/core/flow/kernels/lanes.h"

namespace tracked_mcf::kernels {

/// Number of samples per chunk, small enough for the first-level cache.
constexpr int kChunk = 128;

constexpr float kSampleStep = 1.0F / kSampleSteps;

using Row = float[kChunk];

/// Some samples of one element, one row for each quantity. From `count` to the next multiple of
/// kLanes, the rows are padded such that the padding adds nothing to any integral.
struct SampleChunk {
    alignas(64) float normal[3][kChunk + kLanes];
    Row linear[6];     ///< 1-x and x; the same for y and z
    Row area;          ///< w √|g|, grid units²; 0 if collapsed
    Row tensor[6];     ///< G = w √|g| T g⁻¹ Tᵀ: xx, yy, zz, xy, yz, zx; 0 if collapsed
    Row flux[3][3];    ///< G ∇X_t for each coordinate of X_t; 0 if collapsed
    Row bernstein[9];  ///< (1-x)², x(1-x), x²; the same for y and z
    struct {
        const std::uint32_t* packed_local[2];
        const float* weight;
    } samples;
    int count;
};

/// Reads the samples of an element, chunk by chunk.
struct SampleReader {
    const std::uint32_t* packed_local[2];
    const float* weight;
    std::int64_t left;  ///< samples still to read
    const Fragment* fragment;
    std::int32_t used;  ///< number of samples read from this fragment
};

inline SampleReader read_element(const SampleArrays& samples, std::int64_t element) {
    const std::int64_t begin = samples.sample_begin[element];
    return {{samples.packed_local[0] + begin, samples.packed_local[1] + begin},
            samples.weight + begin,
            samples.sample_begin[element + 1] - begin,
            samples.fragments + samples.fragment_begin[element],
            0};
}

/// Copies the normals of the fragments to their samples.
inline void spread_normals(SampleReader& reader, SampleChunk& chunk) {
    int i = 0;
    while (i < chunk.count) {
        const Lanes x = splat(reader.fragment->normal[0]);
        const Lanes y = splat(reader.fragment->normal[1]);
        const Lanes z = splat(reader.fragment->normal[2]);
        const int rest = reader.fragment->sample_count - reader.used;
        const bool all = rest <= chunk.count - i;
        const int end = all ? i + rest : chunk.count;
        // The next fragment overwrites what this loop writes beyond the end.
        for (int k = i; k < end; k += kLanes) {
            store(x, chunk.normal[0] + k);
            store(y, chunk.normal[1] + k);
            store(z, chunk.normal[2] + k);
        }
        reader.used = all ? 0 : reader.used + end - i;
        reader.fragment += all ? 1 : 0;
        i = end;
    }
    // The padding must not be NaN.
    for (auto& normals : chunk.normal) {
        store(zero(), normals + chunk.count);
    }
}

/// Reads the next chunk.
inline void read_samples(SampleReader& reader, SampleChunk& chunk) {
    chunk.count = reader.left < kChunk ? static_cast<int>(reader.left) : kChunk;
    for (int word = 0; word < 2; ++word) {
        chunk.samples.packed_local[word] = reader.packed_local[word];
        reader.packed_local[word] += chunk.count;
    }
    chunk.samples.weight = reader.weight;
    reader.weight += chunk.count;
    reader.left -= chunk.count;
    spread_normals(reader, chunk);
}

/// Computes the functions of one axis. Both x and 1-x are rounded from the exact number of steps,
/// because one of them is small for functions that hardly meet the surface.
inline void store_functions(std::uint32_t steps, int axis, SampleChunk& chunk, int i) {
    const float x = static_cast<float>(static_cast<std::int32_t>(steps)) * kSampleStep,
                rest = static_cast<float>(kSampleSteps - static_cast<std::int32_t>(steps)) *
                       kSampleStep;
    chunk.linear[2 * axis][i] = rest;
    chunk.linear[2 * axis + 1][i] = x;
    chunk.bernstein[3 * axis][i] = rest * rest;
    chunk.bernstein[3 * axis + 1][i] = x * rest;
    chunk.bernstein[3 * axis + 2][i] = x * x;
}

struct Vector {
    Lanes x, y, z;
};
inline Lanes dot(const Vector& a, const Vector& b) {
    return a.z * b.z + (a.x * b.x + a.y * b.y);
}
inline Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// One coordinate of a trilinear map, as a polynomial of the local coordinates without its constant
/// term.
struct Trilinear {
    float x, y, z, xy, yz, xz, xyz;
};
inline Vector gradient(const Trilinear& p, const Vector& at) {
    const Lanes xy = splat(p.xy);
    const Lanes xz = splat(p.xyz) * at.y + splat(p.xz);
    const Lanes yz = splat(p.xyz) * at.x + splat(p.yz);
    return {xz * at.z + (xy * at.y + splat(p.x)), yz * at.z + (xy * at.x + splat(p.y)),
            yz * at.y + (splat(p.xz) * at.x + splat(p.z))};
}

/// The embedding X_t in the element's cell, up to a constant.
struct Embedding {
    Trilinear x, y, z;
};

/// The vectors from which the metric follows. J_i are the rows of the embedding's derivative.
struct Differential {
    Vector jx, jy, jz;
    Vector kx, ky, kz;  ///< n × J_i
    Vector normal;      ///< -cof(J) n: normal to X_t, of length √|g|
};
inline Differential differential(const Embedding& x, const Vector& at, const Vector& n) {
    const Vector jx = gradient(x.x, at);
    const Vector jy = gradient(x.y, at);
    const Vector jz = gradient(x.z, at);
    Differential d = {
        jx, jy, jz, cross(n, jx), cross(n, jy), cross(n, jz), {zero(), zero(), zero()}};
    // One by one: GCC 12 would copy a whole Vector through memory.
    d.normal.x = dot(jy, d.kz);
    d.normal.y = dot(jz, d.kx);
    d.normal.z = dot(jx, d.ky);
    return d;
}

/// Computes the tensor G of the present metric. The paper has √|g| T g⁻¹ Tᵀ with a basis T of the
/// tangents. This equals Σ_i (n × J_i) (n × J_i)ᵀ / √|g|, because the rotation of T by a right
/// angle turns g into its adjugate. The sum needs no basis, and its entries for directions close to
/// the normal are small without cancellation.
inline void store_tensor(const Differential& d, const Lanes& scale, SampleChunk& chunk, int i) {
    const Vector x = {d.kx.x, d.ky.x, d.kz.x};
    const Vector y = {d.kx.y, d.ky.y, d.kz.y};
    const Vector z = {d.kx.z, d.ky.z, d.kz.z};
    store(scale * dot(x, x), chunk.tensor[0] + i);
    store(scale * dot(y, y), chunk.tensor[1] + i);
    store(scale * dot(z, z), chunk.tensor[2] + i);
    store(scale * dot(x, y), chunk.tensor[3] + i);
    store(scale * dot(y, z), chunk.tensor[4] + i);
    store(scale * dot(z, x), chunk.tensor[5] + i);
}

/// Stores s a - t b.
inline void store_difference(const Vector& a, const Lanes& s, const Vector& b, const Lanes& t,
                             Row (&rows)[3], int i) {
    store(s * a.x - t * b.x, rows[0] + i);
    store(s * a.y - t * b.y, rows[1] + i);
    store(s * a.z - t * b.z, rows[2] + i);
}

/// Computes the fluxes G J_a = Σ_i (n × J_i) (n × J_i) · J_a / √|g|. The factors (n × J_i) · J_a
/// are 0 or, up to sign, coordinates of the normal. Multiplying G by J_a instead would cancel where
/// the surface is compressed.
inline void store_flux(const Differential& d, const Lanes& scale, SampleChunk& chunk, int i) {
    const Vector n = {scale * d.normal.x, scale * d.normal.y, scale * d.normal.z};
    store_difference(d.ky, n.z, d.kz, n.y, chunk.flux[0], i);
    store_difference(d.kz, n.x, d.kx, n.z, chunk.flux[1], i);
    store_difference(d.kx, n.y, d.ky, n.x, chunk.flux[2], i);
}

/// Computes the functions of all three axes.
inline void evaluate_functions(SampleChunk& chunk) {
    const std::uint32_t* const a = chunk.samples.packed_local[0];
    const std::uint32_t* const b = chunk.samples.packed_local[1];
    const int padded = (chunk.count + kLanes - 1) / kLanes * kLanes;
    for (int i = 0; i < padded; ++i) {
        store_functions(a[i] >> kPackedShift, 0, chunk, i);
        store_functions(b[i] >> kPackedShift, 1, chunk, i);
        store_functions((a[i] & kPackedMask) << kPackedShift | (b[i] & kPackedMask), 2, chunk, i);
    }
}

/// Returns the initial normals of kLanes samples, from sample i on.
inline Vector normals(const SampleChunk& chunk, int i) {
    return {load(chunk.normal[0] + i), load(chunk.normal[1] + i), load(chunk.normal[2] + i)};
}

/// Returns their weights, 0 for the padding.
inline Lanes weights(const SampleChunk& chunk, int i) {
    Lanes weights = load(chunk.samples.weight + i);
    for (int lane = chunk.count - i; lane < kLanes; ++lane) weights[lane] = 0;
    return weights;
}

/// Returns the vectors from which their metric follows.
inline Differential differentials(const Embedding& x, const SampleChunk& chunk, int i) {
    const Vector at = {load(chunk.linear[1] + i), load(chunk.linear[3] + i),
                       load(chunk.linear[5] + i)};
    return differential(x, at, normals(chunk, i));
}

/// Computes all rows of a chunk that the moments need.
inline void evaluate_samples(const Embedding& x, SampleChunk& chunk) {
    evaluate_functions(chunk);
    for (int i = 0; i < chunk.count; i += kLanes) {
        const Lanes weight = weights(chunk, i);
        const Differential d = differentials(x, chunk, i);
        const Lanes square = dot(d.normal, d.normal);
        Lanes weighted, scale;
        // Lane by lane: Eigen's roots of vectors are approximations that depend on the processor.
        for (int lane = 0; lane < kLanes; ++lane) {
            const float area = std::sqrt(square[lane]);
            const bool is_sound = area > kCollapsedAreaRatio;
            weighted[lane] = is_sound ? weight[lane] * area : 0;
            scale[lane] = is_sound ? weight[lane] / area : 0;
        }
        store(weighted, chunk.area + i);
        store_tensor(d, scale, chunk, i);
        store_flux(d, scale, chunk, i);
    }
}

}  // namespace tracked_mcf::kernels
