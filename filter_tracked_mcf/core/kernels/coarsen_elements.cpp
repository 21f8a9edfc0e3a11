#include "filter_tracked_mcf/core/kernels/coarsen_elements.h"

#include "filter_tracked_mcf/core/kernels/kernel_table.h"

namespace tracked_mcf {

namespace {

using Lanes = float __attribute__((vector_size(32)));

struct Rows {
    Lanes row[8];
};

constexpr Lanes kUpper[3] = {
    {0, 1, 0, 1, 0, 1, 0, 1}, {0, 0, 1, 1, 0, 0, 1, 1}, {0, 0, 0, 0, 1, 1, 1, 1}};

/// Every lane's number at the other end of its edge along an axis.
template <int Axis>
Lanes other_end(Lanes v) {
    if (Axis == 0) return __builtin_shufflevector(v, v, 1, 0, 3, 2, 5, 4, 7, 6);
    if (Axis == 1) return __builtin_shufflevector(v, v, 2, 3, 0, 1, 6, 7, 4, 5);
    return __builtin_shufflevector(v, v, 4, 5, 6, 7, 0, 1, 2, 3);
}

/// Restricts both ends of one axis: P_c is a product of one such step for each axis. On the side of
/// the parent that the child lies on, its outer function keeps its weight; the function in the
/// parent's middle is half of each of the parent's two.
template <int Axis>
void coarsen_axis(Rows& m, bool upper_child) {
    constexpr int step = 1 << Axis;
    const Lanes is_outer = upper_child ? kUpper[Axis] : 1 - kUpper[Axis];
    const Lanes keep = 0.5F + 0.5F * is_outer;
    const Lanes take = 0.5F * is_outer;
#pragma GCC unroll 8
    for (Lanes& row : m.row) row = keep * row + take * other_end<Axis>(row);
#pragma GCC unroll 8
    for (int lower = 0; lower < 8; ++lower) {
        if ((lower & step) != 0) continue;
        const Lanes low = m.row[lower];
        const Lanes high = m.row[lower + step];
        m.row[lower] = upper_child ? 0.5F * low : low + 0.5F * high;
        m.row[lower + step] = upper_child ? high + 0.5F * low : 0.5F * high;
    }
}

}  // namespace

namespace TRACKED_MCF_KERNELS {

void coarsen_elements(const ChildElements& elements, std::int32_t begin, std::int32_t end,
                      ElementMatrix* parents) {
    for (std::int32_t parent = begin; parent < end; ++parent) {
        Rows sum = {};
        for (std::int64_t k = elements.begin[parent]; k < elements.begin[parent + 1]; ++k) {
            const std::int32_t child = elements.children[k];
            Rows matrix;
            __builtin_memcpy(&matrix, &elements.matrices[child], sizeof matrix);
            const std::uint64_t octant = elements.cells[child];
            coarsen_axis<0>(matrix, (octant & 1U) != 0);
            coarsen_axis<1>(matrix, (octant & 2U) != 0);
            coarsen_axis<2>(matrix, (octant & 4U) != 0);
            for (int i = 0; i < 8; ++i) sum.row[i] += matrix.row[i];
        }
        __builtin_memcpy(&parents[parent], &sum, sizeof sum);
    }
}

}  // namespace TRACKED_MCF_KERNELS

}  // namespace tracked_mcf
