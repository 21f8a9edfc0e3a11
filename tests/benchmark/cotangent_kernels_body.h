// The loops of cotangent_kernels.h, to be included by a file for each set of instructions, inside a
// namespace of its own. Nothing here may call inline functions of other headers: the linker could
// keep the version that not every processor can run.

using Lanes = float __attribute__((vector_size(16), may_alias));
using WideLanes = double __attribute__((vector_size(32), may_alias));

#define TRACKED_MCF_INLINE inline __attribute__((always_inline))

TRACKED_MCF_INLINE Lanes& lanes(Floats& floats) {
    return *reinterpret_cast<Lanes*>(&floats);
}
TRACKED_MCF_INLINE const Lanes& lanes(const Floats& floats) {
    return *reinterpret_cast<const Lanes*>(&floats);
}
TRACKED_MCF_INLINE WideLanes& lanes(Doubles& doubles) {
    return *reinterpret_cast<WideLanes*>(&doubles);
}
TRACKED_MCF_INLINE const WideLanes& lanes(const Doubles& doubles) {
    return *reinterpret_cast<const WideLanes*>(&doubles);
}
TRACKED_MCF_INLINE double dot(const WideLanes& a, const WideLanes& b) {
    const WideLanes product = a * b;
    return product[0] + product[1] + product[2];
}

/// Triangles whose square roots and divisions are done at once.
constexpr int kBatch = 8;

/// A triangle of less quality, 4√3 area / Σ edge², is as stiff as one of this. The reference takes
/// 1e-6, with which conjugate gradients do not converge on scans that have needles.
constexpr double kLeastQuality = 1e-2;

/// What a batch of triangles adds, by corners: to the right side, to the rows' sums, and to the
/// entries of the edges opposite to them. Edge i is opposite to corner i.
struct Batch {
    WideLanes edge0[kBatch], edge1[kBatch];
    double square0[kBatch], square1[kBatch], product01[kBatch];  ///< of the edges
    double force[kBatch];                                        ///< δ / (4 area)
    float mass[kBatch];                                          ///< area / 3
    float entry[3][kBatch];
};

TRACKED_MCF_INLINE void measure(const Assembly& assembly, std::int64_t first, int count,
                                Batch& batch) {
    for (int i = 0; i < count; ++i) {
        const TrianglePlaces& t = assembly.triangles[first + i];
        const WideLanes& a = lanes(assembly.positions[t.vertices[0]]);
        const WideLanes& b = lanes(assembly.positions[t.vertices[1]]);
        const WideLanes& c = lanes(assembly.positions[t.vertices[2]]);
        batch.edge0[i] = c - b;
        batch.edge1[i] = a - c;
        batch.square0[i] = dot(batch.edge0[i], batch.edge0[i]);
        batch.square1[i] = dot(batch.edge1[i], batch.edge1[i]);
        batch.product01[i] = dot(batch.edge0[i], batch.edge1[i]);
    }
}

TRACKED_MCF_INLINE void weigh(const Assembly& assembly, Batch& batch) {
    for (int i = 0; i < kBatch; ++i) {
        const double s0 = batch.square0[i];
        const double s1 = batch.square1[i];
        const double p = batch.product01[i];
        const double gram = s0 * s1 - p * p;
        const double area = 0.5 * __builtin_sqrt(gram > 0 ? gram : 0);
        // 2 (s0 + s1 + p) is the sum of all three squares; √3 is near enough.
        const double least_area = kLeastQuality * 2 / (4 * 1.7320508) * (s0 + s1 + p) + 1e-300;
        const double stiffness =
            assembly.scale * assembly.step_size / (4 * (area > least_area ? area : least_area));
        const double mass = assembly.scale * area / 12;
        batch.force[i] = stiffness;
        batch.mass[i] = static_cast<float>(4 * mass);
        batch.entry[0][i] = static_cast<float>(mass - stiffness * (p + s1));
        batch.entry[1][i] = static_cast<float>(mass - stiffness * (p + s0));
        batch.entry[2][i] = static_cast<float>(mass + stiffness * p);
    }
}

/// The gradient of the area at a corner is n × edge / 2, n the unit normal; here with
/// (e0 × e1) × e = e1 (e0·e) - e0 (e1·e).
TRACKED_MCF_INLINE void add(const Assembly& assembly, std::int64_t first, int count,
                            const Batch& batch) {
    for (int i = 0; i < count; ++i) {
        const TrianglePlaces& t = assembly.triangles[first + i];
        const WideLanes force0 = batch.force[i] * (batch.edge0[i] * batch.product01[i] -
                                                   batch.edge1[i] * batch.square0[i]);
        const WideLanes force1 = batch.force[i] * (batch.edge0[i] * batch.square1[i] -
                                                   batch.edge1[i] * batch.product01[i]);
        lanes(assembly.right_side[t.vertices[0]]) += force0;
        lanes(assembly.right_side[t.vertices[1]]) += force1;
        lanes(assembly.right_side[t.vertices[2]]) -= force0 + force1;
        for (int corner = 0; corner < 3; ++corner) {
            assembly.row_sums[t.vertices[corner]] += batch.mass[i];
            assembly.entries[t.entries[corner]].matrix += batch.entry[corner][i];
        }
    }
}

void assemble(const Assembly& assembly) {
    Batch batch = {};
    for (std::int64_t first = 0; first < assembly.count; first += kBatch) {
        const std::int64_t left = assembly.count - first;
        const int count = left < kBatch ? static_cast<int>(left) : kBatch;
        measure(assembly, first, count, batch);
        weigh(assembly, batch);
        add(assembly, first, count, batch);
    }
}

/// Least pivot, in parts of the diagonal.
constexpr float kLeastPivot = 1e-3F;

void factorize(const Block& block, float relaxation) {
    for (std::int32_t k = block.upper_begin[block.begin]; k < block.upper_begin[block.end]; ++k) {
        const float entry = block.upper[k].matrix;
        block.upper[k].factor = entry < 0 ? entry : 0;
    }
    for (std::int32_t i = block.begin; i < block.end; ++i) block.inverse_diagonal[i] = 0;
    for (std::int32_t i = block.begin; i < block.end; ++i) {
        // Until now it has been what elimination takes from the diagonal.
        const float pivot = block.diagonal[i] - block.inverse_diagonal[i];
        // Positive but for rounding and rows without area.
        const float least = kLeastPivot * block.diagonal[i];
        const float inverse = block.diagonal[i] > 0 ? 1 / (pivot > least ? pivot : least) : 1;
        block.inverse_diagonal[i] = inverse;
        const std::int32_t end = block.upper_begin[i + 1];
        const std::int32_t* fill = block.fill + block.fill_begin[i];
        for (std::int32_t a = block.upper_begin[i]; a < end; ++a) {
            const float factor = inverse * block.upper[a].factor;
            const std::int32_t column = block.upper[a].column;
            block.inverse_diagonal[column] += factor * block.upper[a].factor;
            for (std::int32_t b = a + 1; b < end; ++b, ++fill) {
                const float change = factor * block.upper[b].factor;
                if (*fill >= 0) {
                    block.upper[*fill].factor -= change;
                } else {
                    block.inverse_diagonal[column] += relaxation * change;
                    block.inverse_diagonal[block.upper[b].column] += relaxation * change;
                }
            }
        }
        for (std::int32_t a = block.upper_begin[i]; a < end; ++a) {
            block.upper[a].factor *= inverse;
            block.lower[block.lower_place[a]].factor = block.upper[a].factor;
        }
    }
}

/// From the last row to the first, as backward() goes: an edge is met at its smaller vertex.
void multiply(const Block& block) {
    for (std::int32_t i = block.end - 1; i >= block.begin; --i) {
        const Lanes x = lanes(block.x[i]);
        Lanes q = block.row_sums[i] * x;
        for (std::int32_t k = block.upper_begin[i]; k < block.upper_begin[i + 1]; ++k) {
            const UpperEntry& entry = block.upper[k];
            const Lanes flux = entry.matrix * (lanes(block.x[entry.column]) - x);
            q += flux;
            lanes(block.q[entry.column]) -= flux;
        }
        lanes(block.q[i]) = q;
    }
}

/// Rows that are summed in single precision before their sum is added in double.
constexpr std::int32_t kRowsSummed = 128;

TRACKED_MCF_INLINE void add_to(Doubles& sums, const Lanes& part) {
    for (int i = 0; i < 4; ++i) sums.value[i] += static_cast<double>(part[i]);
}

void forward(const Block& block, const Floats& alpha, Doubles& residual, Doubles& product) {
    const Lanes step = lanes(alpha);
    for (std::int32_t first = block.begin; first < block.end; first += kRowsSummed) {
        const std::int32_t end = block.end - first < kRowsSummed ? block.end : first + kRowsSummed;
        Lanes rr = {0, 0, 0, 0};
        Lanes rz = {0, 0, 0, 0};
        for (std::int32_t i = first; i < end; ++i) {
            const Lanes r = lanes(block.r[i]) - step * lanes(block.q[i]);
            Lanes z = r;
            for (std::int32_t k = block.lower_begin[i]; k < block.lower_begin[i + 1]; ++k) {
                const LowerEntry& entry = block.lower[k];
                z -= entry.factor * lanes(block.z[entry.column]);
            }
            lanes(block.r[i]) = r;
            lanes(block.z[i]) = z;
            rr += r * r;
            rz += z * z * block.inverse_diagonal[i];
        }
        add_to(residual, rr);
        add_to(product, rz);
    }
}

void backward(const Block& block, const Floats& alpha, const Floats& beta, Doubles& product) {
    const Lanes step = lanes(alpha);
    const Lanes share = lanes(beta);
    for (std::int32_t last = block.end; last > block.begin; last -= kRowsSummed) {
        const std::int32_t begin =
            last - block.begin < kRowsSummed ? block.begin : last - kRowsSummed;
        Lanes pq = {0, 0, 0, 0};
        for (std::int32_t i = last - 1; i >= begin; --i) {
            Lanes p = lanes(block.p[i]);
            lanes(block.x[i]) += step * p;
            Lanes z = block.inverse_diagonal[i] * lanes(block.z[i]);
            const std::int32_t first_entry = block.upper_begin[i];
            const std::int32_t end_entry = block.upper_begin[i + 1];
            for (std::int32_t k = first_entry; k < end_entry; ++k) {
                z -= block.upper[k].factor * lanes(block.z[block.upper[k].column]);
            }
            lanes(block.z[i]) = z;
            p = z + share * p;
            lanes(block.p[i]) = p;
            Lanes q = block.row_sums[i] * p;
            pq += q * p;
            for (std::int32_t k = first_entry; k < end_entry; ++k) {
                const UpperEntry& entry = block.upper[k];
                const Lanes difference = lanes(block.p[entry.column]) - p;
                const Lanes flux = entry.matrix * difference;
                q += flux;
                lanes(block.q[entry.column]) -= flux;
                pq -= flux * difference;
            }
            lanes(block.q[i]) = q;
        }
        add_to(product, pq);
    }
}

#undef TRACKED_MCF_INLINE
