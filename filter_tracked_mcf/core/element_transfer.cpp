#include "filter_tracked_mcf/core/element_transfer.h"

#include <array>

#include "filter_tracked_mcf/core/bspline.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

namespace {

/// Of the function at a corner of a child, the parent's functions that contain it, all with the
/// same weight.
struct Containing {
    int count;
    std::array<std::uint8_t, 8> corners;  ///< of the parent
    float weight;
};

/// For every octant and corner of it.
using ContainingTable = std::array<std::array<Containing, 8>, 8>;

ContainingTable make_table() {
    ContainingTable table{};
    for (int octant = 0; octant < 8; ++octant) {
        const auto weights = refinement_weights(octant);
        for (int i = 0; i < 8; ++i) {
            Containing& containing = table[octant][i];
            for (int corner = 0; corner < 8; ++corner) {
                if (weights(i, corner) == 0) continue;
                containing.corners[containing.count++] = static_cast<std::uint8_t>(corner);
                containing.weight = static_cast<float>(weights(i, corner));
            }
        }
    }
    return table;
}

const ContainingTable& table() {
    static const ContainingTable made = make_table();
    return made;
}

/// For every element, bit i: it is the first that has its i-th unknown. Unknowns are numbered in
/// that order.
std::vector<std::uint8_t> first_elements(const Level& level) {
    std::vector<std::uint8_t> first(static_cast<std::size_t>(level.element_count()), 0);
    std::int32_t next = 0;
    serial_for(level.element_count(), [&](std::int64_t element) {
        for (int i = 0; i < 8; ++i) {
            if (level.unknowns[element][i] != next) continue;
            first[element] |= static_cast<std::uint8_t>(1 << i);
            ++next;
        }
    });
    return first;
}

int lowest_bit(int mask) {
    return __builtin_ctz(static_cast<unsigned>(mask));
}

/// Where to add what an element contributes to its eight unknowns.
std::array<float*, 8> places_of(const ElementRange& range, std::int32_t element, float* sums) {
    const std::int64_t detour = range.detours[element / kBlockElements];
    const std::int32_t* const targets =
        detour == ElementRange::kStraight ? range.unknowns + std::int64_t{8} * element
                                          : range.targets + detour + 8 * (element % kBlockElements);
    std::array<float*, 8> places;
    for (int i = 0; i < 8; ++i) {
        const std::int64_t target = targets[i];
        places[i] = target >= 0 ? sums + 4 * target : range.slots + 4 * (-1 - target);
    }
    return places;
}

}  // namespace

ElementTransfer::ElementTransfer(const Level& fine, const Level& coarse)
    : fine_(&fine),
      coarse_(&coarse),
      children_(fine.parents, coarse.element_count()),
      owned_(first_elements(fine)) {}

void ElementTransfer::add_prolongated(const Field& correction,
                                      const std::vector<std::uint8_t>& movable, Field& x) const {
    const ContainingTable& containing = table();
    parallel_for_rows(fine_->element_count(), [&](std::int32_t element) {
        const auto& from = coarse_->unknowns[fine_->parents[element]];
        const auto& of_corner = containing[octant_of(fine_->cells[element])];
        for (int owned = owned_[element]; owned != 0; owned &= owned - 1) {
            const int i = lowest_bit(owned);
            const std::int32_t to = fine_->unknowns[element][i];
            if (movable[to] == 0) continue;
            Eigen::Vector4f sum = Eigen::Vector4f::Zero();
            for (int k = 0; k < of_corner[i].count; ++k) {
                sum += correction.col(from[of_corner[i].corners[k]]);
            }
            x.col(to) += of_corner[i].weight * sum;
        }
    });
}

void ElementTransfer::restrict(const Field& residual, const ElementPartition& coarse_parts,
                               Field& coarse_residual) const {
    const ContainingTable& containing = table();
    coarse_parts.sum(nullptr, coarse_residual, [&](const ElementRange& range, float* sums) {
        for (std::int32_t parent = range.begin; parent < range.end; ++parent) {
            const std::array<float*, 8> to = places_of(range, parent, sums);
            for (const std::int32_t child : children_.members(parent)) {
                const auto& of_corner = containing[octant_of(fine_->cells[child])];
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
        return 0.0;
    });
}

}  // namespace tracked_mcf
