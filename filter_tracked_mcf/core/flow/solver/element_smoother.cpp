// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/element_smoother.h"

#include <algorithm>

#include "filter_tracked_mcf/core/flow/kernels/element_products.h"
#include "filter_tracked_mcf/core/flow/system/constrained_cells.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// Returns 1 / m_e for each element.
std::vector<float> damping_of(const Level& level) {
    std::vector<std::int32_t> sharing(level.unknown_count(), 0);
    for (const auto& unknowns : level.unknowns) {
        for (const std::int32_t unknown : unknowns) ++sharing[unknown];
    }
    std::vector<float> damping(level.unknowns.size());
    parallel_for_rows(level.element_count(), [&](std::int32_t element) {
        std::int32_t most = 1;
        for (const std::int32_t unknown : level.unknowns[element]) {
            most = std::max(most, sharing[unknown]);
        }
        damping[element] = 1.0F / static_cast<float>(most);
    });
    return damping;
}

/// Finds the entries without an index of their own in Couplings, see CoupledElements. An unknown
/// may be coupled with two unknowns at the same corner, if two sheets of the surface in that
/// corner's support connect outside it. The index belongs to the first of the two.
std::vector<std::uint32_t> find_without_place(const Level& level, const ElementBricks& bricks) {
    constexpr std::int32_t none = -1;
    constexpr std::int64_t size = sizeof(Couplings) / sizeof(float);
    RawVector<std::int32_t> coupled_with(size * level.unknown_count());
    parallel_for_rows(level.unknown_count(), [&](std::int32_t unknown) {
        std::fill_n(coupled_with.begin() + size * unknown, size, none);
    });
    const auto for_each_entry = [&](std::int32_t element, const auto& visit) {
        const auto& unknowns = level.unknowns[element];
        for (int i = 0; i < 8; ++i) {
            for (int j = i + 1; j < 8; ++j) {
                visit(coupled_with[size * unknowns[i] + kCouplingIndices.of[i][j]], unknowns[j],
                      kCouplingIndices.bit[i][j]);
            }
        }
    };
    bricks.for_each([&](std::int32_t begin, std::int32_t end) {
        for (std::int32_t element = begin; element < end; ++element) {
            for_each_entry(element, [&](std::int32_t& owner, std::int32_t unknown, int /*bit*/) {
                if (owner == none) owner = unknown;
            });
        }
    });
    std::vector<std::uint32_t> without_place(level.unknowns.size(), 0);
    parallel_for_rows(level.element_count(), [&](std::int32_t element) {
        for_each_entry(element, [&](std::int32_t owner, std::int32_t unknown, int bit) {
            if (owner != unknown) without_place[element] |= std::uint32_t{1} << bit;
        });
    });
    return without_place;
}

}  // namespace

ElementSmoother::ElementSmoother(const Level& level, const ElementBricks& bricks,
                                 const ElementPartition& partition)
    : level_(level),
      bricks_(bricks),
      partition_(partition),
      damping_(damping_of(level)),
      without_place_(find_without_place(level, bricks)),
      inverses_(level.element_count()),
      free_unknowns_(level.unknown_count()) {}

CoupledElements ElementSmoother::coupled(std::int32_t begin, std::int32_t end) const {
    return {level_.unknowns.front().data(), without_place_.data(), begin, end};
}

void ElementSmoother::refresh(const MatrixBlocks& matrices, std::vector<Couplings>& workspace) {
    if (static_cast<std::int64_t>(workspace.size()) < level_.unknown_count()) {
        workspace.resize(level_.unknown_count());
    }
    parallel_for_rows(level_.unknown_count(),
                      [&](std::int32_t unknown) { workspace[unknown] = Couplings{}; });
    bricks_.for_each([&](std::int32_t begin, std::int32_t end) {
        sum_couplings(coupled(begin, end), matrices.blocks(), workspace.data());
    });
    parallel_for_rows(level_.unknown_count(), [&](std::int32_t unknown) {
        free_unknowns_[unknown] = is_free(workspace[unknown].sum[0]) ? 1 : 0;
    });
    parallel_for_chunks(level_.element_count(), [&](std::int64_t begin, std::int64_t end) {
        invert_locally(coupled(static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end)),
                       matrices.blocks(), workspace.data(), damping_.data(), inverses_.blocks());
    });
}

void ElementSmoother::correct(const Field* base, float factor, const Field& residual,
                              Field& x) const {
    partition_.sum(base, x, [&](const ElementRange& range, float* sum) {
        add_element_products(range, inverses_.blocks(), factor, residual.data(), sum);
    });
}

}  // namespace tracked_mcf
