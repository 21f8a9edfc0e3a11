#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/kernels/integrate_elements.h"
#include "filter_tracked_mcf/core/kernels/lanes.h"

// For integrate_elements.cpp alone, see lanes.h.

namespace tracked_mcf::TRACKED_MCF_KERNELS {

/// Samples that are worked on at a time; what is computed of them stays in the first-level cache.
constexpr int kChunk = 128;

constexpr float kStep = 1.0F / kSampleSteps;

using Row = float[kChunk];

/// Some samples of one element, one row for each of their numbers. Behind `count`, up to the next
/// multiple of kLanes, rows are filled so that nothing is added to any integral.
struct SampleChunk {
    alignas(64) float normal[3][kChunk + kLanes];
    Row linear[6];     ///< 1-x and x, and so on for y and z
    Row area;          ///< w √|g|, grid units²; 0 if collapsed
    Row tensor[6];     ///< G = w √|g| T g⁻¹ Tᵀ: xx, yy, zz, xy, yz, zx; 0 if collapsed
    Row pull[3][3];    ///< of each coordinate w √|g| T g⁻¹ Tᵀ ∇X_t; 0 if collapsed
    Row bernstein[9];  ///< (1-x)², x(1-x), x², and so on for y and z
    struct {
        const std::uint32_t* places[2];
        const float* weight;
    } samples;
    int count;
};

/// Where reading an element's samples has come to.
struct SampleReader {
    const std::uint32_t* places[2];
    const float* weight;
    std::int64_t left;
    const Fragment* fragment;
    std::int32_t used;  ///< samples of the fragment that were read
};

TRACKED_MCF_INLINE SampleReader read_element(const SampleArrays& samples, std::int64_t element) {
    const std::int64_t begin = samples.sample_begin[element];
    return {{samples.places[0] + begin, samples.places[1] + begin},
            samples.weight + begin,
            samples.sample_begin[element + 1] - begin,
            samples.fragments + samples.fragment_begin[element],
            0};
}

/// Gives each sample its fragment's normal.
TRACKED_MCF_INLINE void spread_normals(SampleReader& reader, SampleChunk& chunk) {
    int i = 0;
    while (i < chunk.count) {
        const Lanes x = splat(reader.fragment->normal[0]);
        const Lanes y = splat(reader.fragment->normal[1]);
        const Lanes z = splat(reader.fragment->normal[2]);
        const int rest = reader.fragment->sample_count - reader.used;
        const bool all = rest <= chunk.count - i;
        const int end = all ? i + rest : chunk.count;
        // What is written beyond the end, the next fragment overwrites.
        for (int k = i; k < end; k += kLanes) {
            store(x, chunk.normal[0] + k);
            store(y, chunk.normal[1] + k);
            store(z, chunk.normal[2] + k);
        }
        reader.used = all ? 0 : reader.used + end - i;
        reader.fragment += all ? 1 : 0;
        i = end;
    }
    // What is not used must not be NaN.
    for (auto& normals : chunk.normal) {
        store(Lanes{}, normals + chunk.count);
    }
}

/// Goes on to the next samples.
TRACKED_MCF_INLINE void read_samples(SampleReader& reader, SampleChunk& chunk) {
    chunk.count = reader.left < kChunk ? static_cast<int>(reader.left) : kChunk;
    for (int word = 0; word < 2; ++word) {
        chunk.samples.places[word] = reader.places[word];
        reader.places[word] += chunk.count;
    }
    chunk.samples.weight = reader.weight;
    reader.weight += chunk.count;
    reader.left -= chunk.count;
    spread_normals(reader, chunk);
}

/// The coordinate that a word of a place has whole. The word is not a signed number.
TRACKED_MCF_INLINE LaneIndices high_bits(const LaneIndices& words) {
    return words >> kPlaceShift & ((1 << (32 - kPlaceShift)) - 1);
}

/// The functions of one axis. That both x and 1-x are the nearest numbers is worth an instruction:
/// of functions that hardly meet the surface, one of them is small.
TRACKED_MCF_INLINE void store_functions(const LaneIndices& steps, int axis, SampleChunk& chunk,
                                        int i) {
    const Lanes x = to_floats(steps) * kStep;
    const Lanes rest = to_floats(kSampleSteps - steps) * kStep;
    store(rest, chunk.linear[2 * axis] + i);
    store(x, chunk.linear[2 * axis + 1] + i);
    store(rest * rest, chunk.bernstein[3 * axis] + i);
    store(x * rest, chunk.bernstein[3 * axis + 1] + i);
    store(x * x, chunk.bernstein[3 * axis + 2] + i);
}

struct Vector {
    Lanes x, y, z;
};
TRACKED_MCF_INLINE Lanes dot(const Vector& a, const Vector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
TRACKED_MCF_INLINE Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A coordinate of a trilinear map, as a polynomial of the local coordinates. Its constant term is
/// of no interest here.
struct Trilinear {
    float x, y, z, xy, yz, xz, xyz;
};
TRACKED_MCF_INLINE Vector gradient(const Trilinear& p, const Vector& at) {
    const Lanes xz = p.xz + p.xyz * at.y;
    const Lanes yz = p.yz + p.xyz * at.x;
    return {p.x + p.xy * at.y + xz * at.z, p.y + p.xy * at.x + yz * at.z,
            p.z + p.xz * at.x + yz * at.y};
}

/// The embedding X_t in the element's cell, but for a constant.
struct Embedding {
    Trilinear x, y, z;
};

/// What the metric is made of. J_i are the rows of the embedding's derivative.
struct Differential {
    Vector kx, ky, kz;  ///< n × J_i
    Vector normal;      ///< -n under the cofactors of J: as long as √|g|, and normal to X_t
};
TRACKED_MCF_INLINE Differential differential(const Embedding& x, const Vector& at,
                                             const Vector& n) {
    const Vector jx = gradient(x.x, at);
    const Vector jy = gradient(x.y, at);
    const Vector jz = gradient(x.z, at);
    const Vector kx = cross(n, jx);
    const Vector ky = cross(n, jy);
    const Vector kz = cross(n, jz);
    return {kx, ky, kz, {dot(jy, kz), dot(jz, kx), dot(jx, ky)}};
}

/// The tensor of the present metric. The paper's T g⁻¹ Tᵀ √|g|, T a basis of the tangents, is
/// Σ_i (n × J_i) (n × J_i)ᵀ / √|g|: turning a basis by a right angle turns a 2×2 matrix into its
/// adjoint. So no basis is needed, and an entry that belongs to a direction that is nearly the
/// normal comes out small without cancellation.
TRACKED_MCF_INLINE void store_tensor(const Differential& d, const Lanes& scale, SampleChunk& chunk,
                                     int i) {
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

/// s a - t b
TRACKED_MCF_INLINE void store_difference(const Vector& a, const Lanes& s, const Vector& b,
                                         const Lanes& t, Row (&rows)[3], int i) {
    store(s * a.x - t * b.x, rows[0] + i);
    store(s * a.y - t * b.y, rows[1] + i);
    store(s * a.z - t * b.z, rows[2] + i);
}

/// The tensor times J_a, which is Σ_i (n × J_i) (n × J_i) · J_a / √|g|. The products on the right
/// are those of the normal. Multiplying afterwards would cancel where the surface is compressed.
TRACKED_MCF_INLINE void store_pull(const Differential& d, const Lanes& scale, SampleChunk& chunk,
                                   int i) {
    const Vector n = {scale * d.normal.x, scale * d.normal.y, scale * d.normal.z};
    store_difference(d.ky, n.z, d.kz, n.y, chunk.pull[0], i);
    store_difference(d.kz, n.x, d.kx, n.z, chunk.pull[1], i);
    store_difference(d.kx, n.y, d.ky, n.x, chunk.pull[2], i);
}

/// The tensor of the initial metric: the identity but for n nᵀ.
TRACKED_MCF_INLINE void store_initial_tensor(const Vector& n, const Lanes& weight,
                                             SampleChunk& chunk, int i) {
    store(weight * (n.y * n.y + n.z * n.z), chunk.tensor[0] + i);
    store(weight * (n.z * n.z + n.x * n.x), chunk.tensor[1] + i);
    store(weight * (n.x * n.x + n.y * n.y), chunk.tensor[2] + i);
    store(-weight * (n.x * n.y), chunk.tensor[3] + i);
    store(-weight * (n.y * n.z), chunk.tensor[4] + i);
    store(-weight * (n.z * n.x), chunk.tensor[5] + i);
}

/// It times J_a: -n × (n × J_a).
TRACKED_MCF_INLINE void store_initial_pull(const Vector& n, const Vector& k, const Lanes& weight,
                                           Row (&rows)[3], int i) {
    const Vector pull = cross(k, n);
    store(weight * pull.x, rows[0] + i);
    store(weight * pull.y, rows[1] + i);
    store(weight * pull.z, rows[2] + i);
}

/// All that the integrals need of the samples.
TRACKED_MCF_INLINE void evaluate_samples(const Embedding& x, bool initial_metric,
                                         SampleChunk& chunk) {
    for (int i = 0; i < chunk.count; i += kLanes) {
        const LaneIndices a = load(chunk.samples.places[0] + i);
        const LaneIndices b = load(chunk.samples.places[1] + i);
        store_functions(high_bits(a), 0, chunk, i);
        store_functions(high_bits(b), 1, chunk, i);
        store_functions((a & kPlaceMask) << kPlaceShift | (b & kPlaceMask), 2, chunk, i);
    }
    for (int i = 0; i < chunk.count; i += kLanes) {
        const Vector at = {load(chunk.linear[1] + i), load(chunk.linear[3] + i),
                           load(chunk.linear[5] + i)};
        const Vector n = {load(chunk.normal[0] + i), load(chunk.normal[1] + i),
                          load(chunk.normal[2] + i)};
        const Lanes weight =
            kLaneIndex < chunk.count - i ? load(chunk.samples.weight + i) : Lanes{};
        const Differential d = differential(x, at, n);
        const Lanes area = square_root(dot(d.normal, d.normal));
        if (initial_metric) {
            store(weight * area, chunk.area + i);
            store_initial_tensor(n, weight, chunk, i);
            store_initial_pull(n, d.kx, weight, chunk.pull[0], i);
            store_initial_pull(n, d.ky, weight, chunk.pull[1], i);
            store_initial_pull(n, d.kz, weight, chunk.pull[2], i);
        } else {
            const LaneIndices sound = area > kCollapsedAreaRatio;
            store(sound ? weight * area : Lanes{}, chunk.area + i);
            const Lanes scale = sound ? weight / area : Lanes{};
            store_tensor(d, scale, chunk, i);
            store_pull(d, scale, chunk, i);
        }
    }
}

}  // namespace tracked_mcf::TRACKED_MCF_KERNELS
