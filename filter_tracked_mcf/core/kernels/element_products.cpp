#include "filter_tracked_mcf/core/kernels/element_products.h"

#include "filter_tracked_mcf/core/kernels/kernel_table.h"

namespace tracked_mcf {

namespace {

// What is called for every element must be a part of the loop over them: calls would pass the
// columns through memory.
#define TRACKED_MCF_INLINE inline __attribute__((always_inline))

/// One number for each of an element's eight unknowns.
using Lanes = float __attribute__((vector_size(32)));

/// What a field has for one unknown: x, y, z, and a zero.
using Column = float __attribute__((vector_size(16)));

struct Columns {
    Column of_unknown[8];
};

TRACKED_MCF_INLINE Columns transposed(Lanes x, Lanes y, Lanes z) {
    const Lanes zero = {};
    const Lanes xy_even = __builtin_shufflevector(x, y, 0, 8, 1, 9, 4, 12, 5, 13);
    const Lanes xy_odd = __builtin_shufflevector(x, y, 2, 10, 3, 11, 6, 14, 7, 15);
    const Lanes z_even = __builtin_shufflevector(z, zero, 0, 8, 1, 9, 4, 12, 5, 13);
    const Lanes z_odd = __builtin_shufflevector(z, zero, 2, 10, 3, 11, 6, 14, 7, 15);
    const Lanes c04 = __builtin_shufflevector(xy_even, z_even, 0, 1, 8, 9, 4, 5, 12, 13);
    const Lanes c15 = __builtin_shufflevector(xy_even, z_even, 2, 3, 10, 11, 6, 7, 14, 15);
    const Lanes c26 = __builtin_shufflevector(xy_odd, z_odd, 0, 1, 8, 9, 4, 5, 12, 13);
    const Lanes c37 = __builtin_shufflevector(xy_odd, z_odd, 2, 3, 10, 11, 6, 7, 14, 15);
    const auto low = [](Lanes v) { return __builtin_shufflevector(v, v, 0, 1, 2, 3); };
    const auto high = [](Lanes v) { return __builtin_shufflevector(v, v, 4, 5, 6, 7); };
    return {{low(c04), low(c15), low(c26), low(c37), high(c04), high(c15), high(c26), high(c37)}};
}

/// M_e R_e x. The matrix being symmetric, its rows serve as its columns.
TRACKED_MCF_INLINE Columns product(const ElementMatrix& matrix, const std::int32_t* unknowns,
                                   const float* x) {
    Lanes sum_x = {};
    Lanes sum_y = {};
    Lanes sum_z = {};
#pragma GCC unroll 8
    for (int j = 0; j < 8; ++j) {
        Lanes row;
        __builtin_memcpy(&row, matrix.entry[j], sizeof row);
        const float* const of_unknown = x + std::int64_t{4} * unknowns[j];
        sum_x += row * of_unknown[0];
        sum_y += row * of_unknown[1];
        sum_z += row * of_unknown[2];
    }
    return transposed(sum_x, sum_y, sum_z);
}

TRACKED_MCF_INLINE Column load(const float* from) {
    Column column;
    __builtin_memcpy(&column, __builtin_assume_aligned(from, 16), sizeof column);
    return column;
}

TRACKED_MCF_INLINE void store(const Column& column, float* to) {
    __builtin_memcpy(__builtin_assume_aligned(to, 16), &column, sizeof column);
}

TRACKED_MCF_INLINE void add_to(float* to, const Column& column) {
    store(load(to) + column, to);
}

/// Adds to the unknowns of an element, or to where it is to go instead.
TRACKED_MCF_INLINE void add(const ElementRange& range, std::int32_t element, float factor,
                            const Columns& columns, float* y) {
    const std::int32_t detour = range.detours[element];
    if (__builtin_expect(detour == ElementRange::kStraight, 1)) {
        const std::int32_t* const unknowns = range.unknowns + std::int64_t{8} * element;
#pragma GCC unroll 8
        for (int i = 0; i < 8; ++i) {
            add_to(y + std::int64_t{4} * unknowns[i], factor * columns.of_unknown[i]);
        }
        return;
    }
    for (int i = 0; i < 8; ++i) {
        const std::int64_t target = range.targets[detour + i];
        add_to(target >= 0 ? y + 4 * target : range.slots + 4 * (-1 - target),
               factor * columns.of_unknown[i]);
    }
}

}  // namespace

namespace TRACKED_MCF_KERNELS {

void add_element_products(const ElementRange& range, const ElementMatrix* matrices, float factor,
                          const float* x, float* y) {
    for (std::int32_t element = range.begin; element < range.end; ++element) {
        const std::int32_t* const unknowns = range.unknowns + std::int64_t{8} * element;
        add(range, element, factor, product(matrices[element], unknowns, x), y);
    }
}

double add_element_products_and_dot(const ElementRange& range, const ElementMatrix* matrices,
                                    const float* x, float* y) {
    double dot = 0;
    for (std::int32_t element = range.begin; element < range.end; ++element) {
        const std::int32_t* const unknowns = range.unknowns + std::int64_t{8} * element;
        const Columns products = product(matrices[element], unknowns, x);
        Column of_element = {};
#pragma GCC unroll 8
        for (int i = 0; i < 8; ++i) {
            of_element += load(x + std::int64_t{4} * unknowns[i]) * products.of_unknown[i];
        }
        dot += of_element[0] + of_element[1] + of_element[2];
        add(range, element, 1, products, y);
    }
    return dot;
}

void add_packed_products(const ElementRange& range, const PackedMatrix* matrices, float factor,
                         const float* x, float* y) {
    for (std::int32_t element = range.begin; element < range.end; ++element) {
        const std::int32_t* const unknowns = range.unknowns + std::int64_t{8} * element;
        const float* entry = matrices[element].entry;
        Column columns[8];
        Columns products = {};
#pragma GCC unroll 8
        for (int i = 0; i < 8; ++i) columns[i] = load(x + std::int64_t{4} * unknowns[i]);
#pragma GCC unroll 8
        for (int i = 0; i < 8; ++i) {
            products.of_unknown[i] += *entry++ * columns[i];
#pragma GCC unroll 8
            for (int j = i + 1; j < 8; ++j) {
                products.of_unknown[i] += *entry * columns[j];
                products.of_unknown[j] += *entry++ * columns[i];
            }
        }
        add(range, element, factor, products, y);
    }
}

void add_element_vectors(const ElementRange& range, const ElementVector* vectors, float* y) {
    for (std::int32_t element = range.begin; element < range.end; ++element) {
        Lanes entry[3];
        __builtin_memcpy(entry, vectors[element].entry, sizeof entry);
        add(range, element, 1, transposed(entry[0], entry[1], entry[2]), y);
    }
}

}  // namespace TRACKED_MCF_KERNELS

}  // namespace tracked_mcf
