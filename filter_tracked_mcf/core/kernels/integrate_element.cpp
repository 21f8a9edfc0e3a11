#include "filter_tracked_mcf/core/kernels/integrate_element.h"

namespace tracked_mcf::TRACKED_MCF_KERNELS {

namespace {

/// One number for each of a cell's eight functions (numbered as in bspline.h).
using Lanes = float __attribute__((vector_size(32)));

#define TRACKED_MCF_INLINE inline __attribute__((always_inline))

constexpr Lanes kUpperX = {0, 1, 0, 1, 0, 1, 0, 1};
constexpr Lanes kUpperY = {0, 0, 1, 1, 0, 0, 1, 1};
constexpr Lanes kUpperZ = {0, 0, 0, 0, 1, 1, 1, 1};
constexpr Lanes kSlopeX = 2 * kUpperX - 1;
constexpr Lanes kSlopeY = 2 * kUpperY - 1;
constexpr Lanes kSlopeZ = 2 * kUpperZ - 1;

struct Vector {
    float x, y, z;
};

TRACKED_MCF_INLINE Vector operator+(const Vector& a, const Vector& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
TRACKED_MCF_INLINE Vector operator*(float s, const Vector& a) {
    return {s * a.x, s * a.y, s * a.z};
}
TRACKED_MCF_INLINE float dot(const Vector& a, const Vector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
TRACKED_MCF_INLINE Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Orthonormal basis (t1, t2) of the plane with a unit normal (Duff et al., "Building an
/// Orthonormal Basis, Revisited", 2017). Which basis, does not matter to the integrals.
struct Tangents {
    Vector t1, t2;
};
TRACKED_MCF_INLINE Tangents tangents_of(const float (&n)[3]) {
    const float sign = n[2] < 0 ? -1.0F : 1.0F;
    const float x = n[0];
    const float y = n[1];
    const float z = n[2];
    const float a = -1 / (sign + z);
    const float b = x * y * a;
    return {{1 + sign * x * x * a, sign * b, -sign * x}, {b, sign + y * y * a, -y}};
}

/// A coordinate of a trilinear map, as a polynomial of the local coordinates. Its constant term is
/// of no interest here.
struct Trilinear {
    float x, y, z, xy, yz, xz, xyz;
};
TRACKED_MCF_INLINE Trilinear trilinear(const float (&c)[8]) {
    Trilinear p;
    p.x = c[1] - c[0];
    p.y = c[2] - c[0];
    p.z = c[4] - c[0];
    p.xy = c[3] - c[2] - p.x;
    p.yz = c[6] - c[4] - p.y;
    p.xz = c[5] - c[4] - p.x;
    p.xyz = c[7] - c[6] - c[5] + c[4] - p.xy;
    return p;
}
TRACKED_MCF_INLINE Vector gradient(const Trilinear& p, const Vector& at) {
    return {p.x + p.xy * at.y + (p.xz + p.xyz * at.y) * at.z,
            p.y + p.xy * at.x + (p.yz + p.xyz * at.x) * at.z,
            p.z + p.xz * at.x + (p.yz + p.xyz * at.x) * at.y};
}

/// The eight functions and their derivatives at a point.
struct Functions {
    Lanes value, dx, dy, dz;
};
TRACKED_MCF_INLINE Functions functions_at(const Vector& at) {
    const Lanes x = (1 - kUpperX) + kSlopeX * at.x;
    const Lanes y = (1 - kUpperY) + kSlopeY * at.y;
    const Lanes z = (1 - kUpperZ) + kSlopeZ * at.z;
    const Lanes yz = y * z;
    return {x * yz, kSlopeX * yz, x * (kSlopeY * z), (x * y) * kSlopeZ};
}
TRACKED_MCF_INLINE Lanes derivative_along(const Functions& f, const Vector& q) {
    return q.x * f.dx + q.y * f.dy + q.z * f.dz;
}

/// The lower triangular C with C Cᵀ = √|g| g⁻¹ for the metric g of dX = [a b], whose √|g| is
/// `area`. The initial metric's is the identity.
struct MetricFactor {
    float c11, c21, c22;
};
TRACKED_MCF_INLINE MetricFactor factor(const Vector& a, const Vector& b, float area) {
    const float inverse_area = 1 / area;
    const float c11 = __builtin_sqrtf(dot(b, b) * inverse_area);
    const float c22 = 1 / c11;
    return {c11, -dot(a, b) * inverse_area * c22, c22};
}

}  // namespace

ElementTotals integrate_element(const ElementInput& input, ElementMatrix& matrix,
                                ElementVector& right_side) {
    Lanes rows[8] = {};
    Lanes force[3] = {};
    ElementTotals totals = {};

    const Trilinear ux = trilinear(input.displacement[0]);
    const Trilinear uy = trilinear(input.displacement[1]);
    const Trilinear uz = trilinear(input.displacement[2]);

    const Sample* sample = input.samples;
    for (const Fragment* fragment = input.fragments; fragment != input.fragments_end; ++fragment) {
        const Tangents t = tangents_of(fragment->normal);
        for (std::int32_t i = 0; i < fragment->sample_count; ++i, ++sample) {
            const Vector at = {sample->local[0], sample->local[1], sample->local[2]};

            // ComputeDifferential (section 4.3): dX = [J t1, J t2] with J = I + ∇u.
            const Vector gx = gradient(ux, at);
            const Vector gy = gradient(uy, at);
            const Vector gz = gradient(uz, at);
            const Vector a = t.t1 + Vector{dot(gx, t.t1), dot(gy, t.t1), dot(gz, t.t1)};
            const Vector b = t.t2 + Vector{dot(gx, t.t2), dot(gy, t.t2), dot(gz, t.t2)};

            // √|g| as the length of a × b, which cancels far less than a determinant.
            const Vector normal = cross(a, b);
            const float area = __builtin_sqrtf(dot(normal, normal));
            if (!input.initial_metric && !(area > kCollapsedAreaRatio)) {
                ++totals.collapsed_samples;
                const Lanes value = functions_at(at).value;
                const Lanes mass = sample->weight * value * value;
                for (int corner = 0; corner < 8; ++corner) {
                    totals.collapsed_mass[corner] += mass[corner];
                }
                continue;
            }

            // √|g| g⁻¹ = C Cᵀ with C lower triangular and of determinant 1; q = [t1 t2] C.
            const MetricFactor c =
                input.initial_metric ? MetricFactor{1, 0, 1} : factor(a, b, area);
            const Vector q1 = c.c11 * t.t1 + c.c21 * t.t2;
            const Vector q2 = c.c22 * t.t2;
            const Vector jq1 = c.c11 * a + c.c21 * b;
            const Vector jq2 = c.c22 * b;

            const Functions f = functions_at(at);
            const Lanes p1 = derivative_along(f, q1);
            const Lanes p2 = derivative_along(f, q2);

            const float mass = input.mass * sample->weight * area;
            const float stiffness = input.stiffness * sample->weight;
            const Lanes mf = mass * f.value;
            const Lanes sp1 = stiffness * p1;
            const Lanes sp2 = stiffness * p2;
            for (int row = 0; row < 8; ++row) {
                rows[row] += mf[row] * f.value + sp1[row] * p1 + sp2[row] * p2;
            }
            force[0] -= sp1 * jq1.x + sp2 * jq2.x;
            force[1] -= sp1 * jq1.y + sp2 * jq2.y;
            force[2] -= sp1 * jq1.z + sp2 * jq2.z;
            totals.area += sample->weight * area;
        }
    }

    for (int row = 0; row < 8; ++row) {
        for (int column = 0; column < 8; ++column) matrix.entry[row][column] = rows[row][column];
    }
    for (int axis = 0; axis < 3; ++axis) {
        for (int corner = 0; corner < 8; ++corner) {
            right_side.entry[axis][corner] = force[axis][corner];
        }
    }
    return totals;
}

}  // namespace tracked_mcf::TRACKED_MCF_KERNELS
