// SPDX-License-Identifier: GPL-3.0-or-later

// Only integrate_elements.cpp includes this, see lanes.h.
#if defined(TRACKED_MCF_SAMPLE_CHUNK_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TRACKED_MCF_SAMPLE_CHUNK_H
#undef TRACKED_MCF_SAMPLE_CHUNK_H
#else
#define TRACKED_MCF_SAMPLE_CHUNK_H
#endif

#include <cstddef>
#include <cstdint>

#include "filter_tracked_mcf/core/flow/kernels/integrate_elements.h"
#include "filter_tracked_mcf/core/flow/kernels/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace tracked_mcf::HWY_NAMESPACE {

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

static HWY_INLINE SampleReader read_element(const SampleArrays& samples, std::int64_t element) {
    const std::int64_t begin = samples.sample_begin[element];
    return {{samples.packed_local[0] + begin, samples.packed_local[1] + begin},
            samples.weight + begin,
            samples.sample_begin[element + 1] - begin,
            samples.fragments + samples.fragment_begin[element],
            0};
}

/// Copies the normals of the fragments to their samples.
static HWY_INLINE void spread_normals(SampleReader& reader, SampleChunk& chunk) {
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
static HWY_INLINE void read_samples(SampleReader& reader, SampleChunk& chunk) {
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

static HWY_INLINE Lanes to_floats(const Words& numbers) {
    constexpr hn::RebindToSigned<decltype(kWords)> integers;
    return hn::ConvertTo(kFloats, hn::BitCast(integers, numbers));
}

/// Computes the functions of one axis. Both x and 1-x are rounded from the exact number of steps,
/// because one of them is small for functions that hardly meet the surface.
static HWY_INLINE void store_functions(const Words& steps, int axis, SampleChunk& chunk, int i) {
    const Lanes x = to_floats(steps) * splat(kSampleStep);
    const Lanes rest = to_floats(hn::Set(kWords, kSampleSteps) - steps) * splat(kSampleStep);
    store(rest, chunk.linear[2 * axis] + i);
    store(x, chunk.linear[2 * axis + 1] + i);
    store(rest * rest, chunk.bernstein[3 * axis] + i);
    store(x * rest, chunk.bernstein[3 * axis + 1] + i);
    store(x * x, chunk.bernstein[3 * axis + 2] + i);
}

struct Vector {
    Lanes x, y, z;
};
static HWY_INLINE Lanes dot(const Vector& a, const Vector& b) {
    return hn::MulAdd(a.z, b.z, hn::MulAdd(a.x, b.x, a.y * b.y));
}
static HWY_INLINE Vector cross(const Vector& a, const Vector& b) {
    return {hn::MulSub(a.y, b.z, a.z * b.y), hn::MulSub(a.z, b.x, a.x * b.z),
            hn::MulSub(a.x, b.y, a.y * b.x)};
}

/// One coordinate of a trilinear map, as a polynomial of the local coordinates without its constant
/// term.
struct Trilinear {
    float x, y, z, xy, yz, xz, xyz;
};
static HWY_INLINE Vector gradient(const Trilinear& p, const Vector& at) {
    const Lanes xy = splat(p.xy);
    const Lanes xz = hn::MulAdd(splat(p.xyz), at.y, splat(p.xz));
    const Lanes yz = hn::MulAdd(splat(p.xyz), at.x, splat(p.yz));
    return {hn::MulAdd(xz, at.z, hn::MulAdd(xy, at.y, splat(p.x))),
            hn::MulAdd(yz, at.z, hn::MulAdd(xy, at.x, splat(p.y))),
            hn::MulAdd(yz, at.y, hn::MulAdd(splat(p.xz), at.x, splat(p.z)))};
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
static HWY_INLINE Differential differential(const Embedding& x, const Vector& at, const Vector& n) {
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
static HWY_INLINE void store_tensor(const Differential& d, const Lanes& scale, SampleChunk& chunk,
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

/// Stores s a - t b.
static HWY_INLINE void store_difference(const Vector& a, const Lanes& s, const Vector& b,
                                        const Lanes& t, Row (&rows)[3], int i) {
    store(hn::MulSub(s, a.x, t * b.x), rows[0] + i);
    store(hn::MulSub(s, a.y, t * b.y), rows[1] + i);
    store(hn::MulSub(s, a.z, t * b.z), rows[2] + i);
}

/// Computes the fluxes G J_a = Σ_i (n × J_i) (n × J_i) · J_a / √|g|. The factors (n × J_i) · J_a
/// are 0 or, up to sign, coordinates of the normal. Multiplying G by J_a instead would cancel where
/// the surface is compressed.
static HWY_INLINE void store_flux(const Differential& d, const Lanes& scale, SampleChunk& chunk,
                                  int i) {
    const Vector n = {scale * d.normal.x, scale * d.normal.y, scale * d.normal.z};
    store_difference(d.ky, n.z, d.kz, n.y, chunk.flux[0], i);
    store_difference(d.kz, n.x, d.kx, n.z, chunk.flux[1], i);
    store_difference(d.kx, n.y, d.ky, n.x, chunk.flux[2], i);
}

/// Computes the functions of all three axes.
static HWY_INLINE void evaluate_functions(SampleChunk& chunk) {
    for (int i = 0; i < chunk.count; i += kLanes) {
        const Words a = hn::LoadU(kWords, chunk.samples.packed_local[0] + i);
        const Words b = hn::LoadU(kWords, chunk.samples.packed_local[1] + i);
        const Words mask = hn::Set(kWords, kPackedMask);
        store_functions(hn::ShiftRight<kPackedShift>(a), 0, chunk, i);
        store_functions(hn::ShiftRight<kPackedShift>(b), 1, chunk, i);
        store_functions(hn::ShiftLeft<kPackedShift>(a & mask) | (b & mask), 2, chunk, i);
    }
}

/// Returns the initial normals of kLanes samples, from sample i on.
static HWY_INLINE Vector normals(const SampleChunk& chunk, int i) {
    return {load(chunk.normal[0] + i), load(chunk.normal[1] + i), load(chunk.normal[2] + i)};
}

/// Returns their weights, 0 for the padding.
static HWY_INLINE Lanes weights(const SampleChunk& chunk, int i) {
    const auto count = static_cast<std::size_t>(chunk.count - i);
    return hn::IfThenElseZero(hn::FirstN(kFloats, count), load(chunk.samples.weight + i));
}

/// Returns the vectors from which their metric follows.
static HWY_INLINE Differential differentials(const Embedding& x, const SampleChunk& chunk, int i) {
    const Vector at = {load(chunk.linear[1] + i), load(chunk.linear[3] + i),
                       load(chunk.linear[5] + i)};
    return differential(x, at, normals(chunk, i));
}

/// Computes all rows of a chunk that the moments need.
static HWY_INLINE void evaluate_samples(const Embedding& x, SampleChunk& chunk) {
    evaluate_functions(chunk);
    for (int i = 0; i < chunk.count; i += kLanes) {
        const Lanes weight = weights(chunk, i);
        const Differential d = differentials(x, chunk, i);
        const Lanes area = hn::Sqrt(dot(d.normal, d.normal));
        const auto sound = area > splat(kCollapsedAreaRatio);
        store(hn::IfThenElseZero(sound, weight * area), chunk.area + i);
        const Lanes scale = hn::IfThenElseZero(sound, weight / area);
        store_tensor(d, scale, chunk, i);
        store_flux(d, scale, chunk, i);
    }
}

}  // namespace tracked_mcf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target guard
