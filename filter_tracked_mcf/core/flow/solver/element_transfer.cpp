// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/element_transfer.h"

#include <array>

#include "filter_tracked_mcf/core/flow/cells/bspline.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// The functions of a parent cell that contain the function at one corner of a child cell. They all
/// have the same weight.
struct ContainingFunctions {
    int count;
    std::array<std::uint8_t, 8> corners;  ///< of the parent
    float weight;
};

/// The containing functions for each octant and each corner of it.
using RefinementTable = std::array<std::array<ContainingFunctions, 8>, 8>;

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

/// Returns the table of the refinement weights (bspline.h).
const RefinementTable& refinement_table() {
    static const RefinementTable table = make_refinement_table();
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

/// All 64 entries of an element's matrix.
using Matrix = Eigen::Array<float, 8, 8, Eigen::RowMajor>;
using Row = Eigen::Array<float, 1, 8>;

/// Returns a row with the entries of the two corners of each cell edge along the axis exchanged.
template <int Axis>
Row other_end(const Row& row) {
    Row other;
    for (int i = 0; i < 8; ++i) other[i] = row[i ^ (1 << Axis)];
    return other;
}

/// For each axis, the weights of a child's entries: 1 for corners on the outer side, half for those
/// in the parent's middle. First if the lower side is outer, then if the upper side is.
constexpr float kKeep[3][2][8] = {{{1, .5, 1, .5, 1, .5, 1, .5}, {.5, 1, .5, 1, .5, 1, .5, 1}},
                                  {{1, 1, .5, .5, 1, 1, .5, .5}, {.5, .5, 1, 1, .5, .5, 1, 1}},
                                  {{1, 1, 1, 1, .5, .5, .5, .5}, {.5, .5, .5, .5, 1, 1, 1, 1}}};

/// Multiplies by the factor of P_c that belongs to one axis, from both sides. Along the axis, the
/// child has an outer function, at the parent's corner, and one in the parent's middle. The outer
/// one belongs to the parent's function at that corner; the middle one belongs half to each of the
/// parent's two functions.
template <int Axis>
void coarsen_axis(Matrix& m, bool upper_child) {
    constexpr int step = 1 << Axis;
    const Row keep = Eigen::Map<const Row>(kKeep[Axis][upper_child ? 1 : 0]), take = keep - 0.5F;
    for (int i = 0; i < 8; ++i) {
        const Row row = m.row(i);
        m.row(i) = keep * row + take * other_end<Axis>(row);
    }
    for (int lower = 0; lower < 8; ++lower) {
        if ((lower & step) != 0) continue;
        const Row low = m.row(lower), high = m.row(lower + step);
        m.row(lower) = upper_child ? Row(0.5F * low) : Row(0.5F * high + low);
        m.row(lower + step) = upper_child ? Row(0.5F * low + high) : Row(0.5F * high);
    }
}

}  // namespace

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
    coarse_partition.sum(nullptr, coarse_residual, [&](std::int32_t parent, const auto& at) {
        const auto& to = coarse_->unknowns[parent];
        for (const std::int32_t child : children_.members(parent)) {
            const auto& of_corner = table[octant_of(fine_->cells[child])];
            for (int owned = owned_[child]; owned != 0; owned &= owned - 1) {
                const int i = lowest_bit(owned);
                const Eigen::Vector4f share =
                    of_corner[i].weight * residual.col(fine_->unknowns[child][i]);
                for (int k = 0; k < of_corner[i].count; ++k)
                    at(to[of_corner[i].corners[k]]) += share;
            }
        }
    });
}

void ElementTransfer::coarsen(const MatrixBlocks& fine, MatrixBlocks& coarse) const {
    coarse.resize(coarse_->unknowns.size());
    parallel_for_rows(coarse_->element_count(), [&](std::int32_t parent) {
        Matrix sum = Matrix::Zero();
        for (const std::int32_t child : children_.members(parent)) {
            Matrix matrix;
            for (int i = 0; i < 8; ++i) {
                for (int j = 0; j < 8; ++j) matrix(i, j) = fine[child](i, j);
            }
            const int octant = octant_of(fine_->cells[child]);
            coarsen_axis<0>(matrix, corner_bit(octant, 0) != 0);
            coarsen_axis<1>(matrix, corner_bit(octant, 1) != 0);
            coarsen_axis<2>(matrix, corner_bit(octant, 2) != 0);
            sum += matrix;
        }
        for (int i = 0; i < 8; ++i) {
            for (int j = i; j < 8; ++j) coarse[parent](i, j) = sum(i, j);
        }
    });
}

}  // namespace tracked_mcf
