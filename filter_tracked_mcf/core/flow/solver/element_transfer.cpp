// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/element_transfer.h"

#include "filter_tracked_mcf/core/flow/cells/bspline.h"
#include "filter_tracked_mcf/core/flow/kernels/coarsen_elements.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

RefinementTable make_refinement_table() {
    RefinementTable table{};
    for (int octant = 0; octant < 8; ++octant) {
        const auto weights = refinement_weights(octant);
        for (int i = 0; i < 8; ++i) {
            ContainingFunctions& containing = table[octant][i];
            for (int corner = 0; corner < 8; ++corner) {
                if (weights(i, corner) == 0) continue;
                containing.corners[containing.count++] = static_cast<std::uint8_t>(corner);
                containing.weight = static_cast<float>(weights(i, corner));
            }
        }
    }
    return table;
}

/// Returns for each element a mask of the unknowns that no earlier element has. Unknowns are
/// numbered in the order in which elements first have them.
std::vector<std::uint8_t> owned_unknowns(const Level& level) {
    std::vector<std::uint8_t> owned(level.unknowns.size(), 0);
    std::int32_t next = 0;
    for (std::size_t element = 0; element < owned.size(); ++element) {
        for (int i = 0; i < 8; ++i) {
            if (level.unknowns[element][i] != next) continue;
            owned[element] |= static_cast<std::uint8_t>(1 << i);
            ++next;
        }
    }
    return owned;
}

int lowest_bit(int mask) {
    int bit = 0;
    while (((mask >> bit) & 1) == 0) ++bit;
    return bit;
}

}  // namespace

const RefinementTable& refinement_table() {
    static const RefinementTable table = make_refinement_table();
    return table;
}

ElementTransfer::ElementTransfer(const Level& fine, const Level& coarse)
    : fine_(&fine),
      coarse_(&coarse),
      children_(fine.parents, coarse.element_count()),
      owned_(owned_unknowns(fine)) {}

void ElementTransfer::add_prolongated(const Field& correction,
                                      const std::vector<std::uint8_t>& free_unknowns,
                                      Field& x) const {
    const RefinementTable& table = refinement_table();
    parallel_for_rows(fine_->element_count(), [&](std::int32_t element) {
        const auto& from = coarse_->unknowns[fine_->parents[element]];
        const auto& of_corner = table[octant_of(fine_->cells[element])];
        for (int owned = owned_[element]; owned != 0; owned &= owned - 1) {
            const int i = lowest_bit(owned);
            const std::int32_t to = fine_->unknowns[element][i];
            if (free_unknowns[to] == 0) continue;
            Eigen::Vector4f sum = Eigen::Vector4f::Zero();
            for (int k = 0; k < of_corner[i].count; ++k) {
                sum += correction.col(from[of_corner[i].corners[k]]);
            }
            x.col(to) += of_corner[i].weight * sum;
        }
    });
}

void ElementTransfer::restrict(const Field& residual, const ElementPartition& coarse_partition,
                               Field& coarse_residual) const {
    const RefinementTable& table = refinement_table();
    coarse_partition.sum(nullptr, coarse_residual, [&](const ElementRange& range, float* sums) {
        for (std::int32_t parent = range.begin; parent < range.end; ++parent) {
            const std::array<float*, 8> to = targets_of(range, parent, sums);
            for (const std::int32_t child : children_.members(parent)) {
                const auto& of_corner = table[octant_of(fine_->cells[child])];
                for (int owned = owned_[child]; owned != 0; owned &= owned - 1) {
                    const int i = lowest_bit(owned);
                    const Eigen::Vector4f share =
                        of_corner[i].weight * residual.col(fine_->unknowns[child][i]);
                    for (int k = 0; k < of_corner[i].count; ++k) {
                        Eigen::Map<Eigen::Vector4f, Eigen::Aligned16>(
                            to[of_corner[i].corners[k]]) += share;
                    }
                }
            }
        }
    });
}

void coarsen_element_matrices(const Level& fine, const Groups& children,
                              const MatrixBlocks& fine_matrices, MatrixBlocks& coarse_matrices) {
    const ChildElements elements = {fine_matrices.blocks(), fine.cells.data(), children.items(),
                                    children.begins()};
    parallel_for_chunks(coarse_matrices.size(), [&](std::int64_t begin, std::int64_t end) {
        coarsen_elements(elements, static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end),
                         coarse_matrices.blocks());
    });
}

}  // namespace tracked_mcf
