#include "filter_tracked_mcf/core/galerkin.h"

#include "filter_tracked_mcf/core/bspline.h"
#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

namespace {

/// Restricts both ends of one axis: P_c is a product of one such step for each axis. On the side of
/// the parent that the child lies on, its outer function keeps its weight; the function in the
/// parent's middle is half of each of the parent's two.
template <int Axis>
void coarsen_axis(ElementMatrix& m, bool upper_child) {
    constexpr int step = 1 << Axis;
    for (int lower = 0; lower < 8; ++lower) {
        if ((lower & step) != 0) continue;
        const int upper = lower + step;
        float* const outer = upper_child ? m.entry[upper] : m.entry[lower];
        float* const middle = upper_child ? m.entry[lower] : m.entry[upper];
        for (int column = 0; column < 8; ++column) {
            middle[column] *= 0.5F;
            outer[column] += middle[column];
        }
    }
    for (auto& row : m.entry) {
        for (int lower = 0; lower < 8; ++lower) {
            if ((lower & step) != 0) continue;
            const int upper = lower + step;
            float& outer = upper_child ? row[upper] : row[lower];
            float& middle = upper_child ? row[lower] : row[upper];
            middle *= 0.5F;
            outer += middle;
        }
    }
}

void leave_out(ElementMatrix& m, int corner) {
    for (int i = 0; i < 8; ++i) m.entry[corner][i] = m.entry[i][corner] = 0;
}

/// Overwrites the child.
void add_child(ElementMatrix& parent, ElementMatrix& child, int octant) {
    coarsen_axis<0>(child, corner_bit(octant, 0) != 0);
    coarsen_axis<1>(child, corner_bit(octant, 1) != 0);
    coarsen_axis<2>(child, corner_bit(octant, 2) != 0);
    for (int row = 0; row < 8; ++row) {
        for (int column = 0; column < 8; ++column) {
            parent.entry[row][column] += child.entry[row][column];
        }
    }
}

}  // namespace

void coarsen_element_matrices(const Level& fine, const Groups& children,
                              const std::vector<std::uint8_t>& frozen,
                              const std::vector<ElementMatrix>& fine_matrices,
                              std::vector<ElementMatrix>& coarse_matrices) {
    parallel_for_blocks(static_cast<std::int64_t>(coarse_matrices.size()), [&](std::int64_t begin,
                                                                               std::int64_t end) {
        for (std::int64_t parent = begin; parent < end; ++parent) {
            ElementMatrix sum{};
            for (const std::int32_t child : children.members(static_cast<std::int32_t>(parent))) {
                ElementMatrix matrix = fine_matrices[child];
                for (int corner = 0; corner < 8; ++corner) {
                    if (frozen[fine.unknowns[child][corner]] != 0) {
                        leave_out(matrix, corner);
                    }
                }
                add_child(sum, matrix, octant_of(fine.cells[child]));
            }
            coarse_matrices[parent] = sum;
        }
    });
}

}  // namespace tracked_mcf
