#include "filter_tracked_mcf/core/element_smoother.h"

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/element_products.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/kernels/coupling_places.h"
#include "filter_tracked_mcf/core/kernels/kernels.h"
#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

namespace {

/// Whatever so small a function does, the surface does not see it.
constexpr float kSmallestDiagonal = 1e-30F;

/// Of every element, 1 / the number of elements that have the most shared of its unknowns.
std::vector<float> shares_of(const Level& level) {
    std::vector<std::int32_t> sharing(static_cast<std::size_t>(level.unknown_count()), 0);
    for_each_item(level.unknowns, [&](const auto& unknowns) {
        for (const std::int32_t unknown : unknowns) ++sharing[unknown];
    });
    std::vector<float> shares;
    resize(shares, level.element_count());
    parallel_for_rows(level.element_count(), [&](std::int32_t element) {
        std::int32_t most = 1;
        for (const std::int32_t unknown : level.unknowns[element]) {
            most = std::max(most, sharing[unknown]);
        }
        shares[element] = 1.0F / static_cast<float>(most);
    });
    return shares;
}

/// Finds the entries that have no place of their own in Couplings: an unknown may be coupled with
/// two at the same corner, where the surface in that corner's support is in two parts and one of
/// them leads on to the other side. The first such keeps the place.
std::vector<std::uint32_t> entries_apart(const Level& level, const ElementBlocks& blocks) {
    constexpr std::int32_t none = -1;
    constexpr std::int64_t places = sizeof(Couplings) / sizeof(float);
    std::vector<std::int32_t> coupled_with;
    resize(coupled_with, places * level.unknown_count());
    parallel_for_rows(level.unknown_count(), [&](std::int32_t unknown) {
        std::fill_n(coupled_with.begin() + places * unknown, places, none);
    });
    const auto for_each_entry = [&](std::int32_t element, const auto& visit) {
        const auto& unknowns = level.unknowns[element];
        for (int i = 0; i < 8; ++i) {
            for (int j = i + 1; j < 8; ++j) {
                const std::int64_t place = places * unknowns[i] + kCouplingPlaces.place[i][j];
                visit(coupled_with[place], unknowns[j], kCouplingPlaces.bit[i][j]);
            }
        }
    };
    blocks.for_each([&](std::int32_t begin, std::int32_t end) {
        for (std::int32_t element = begin; element < end; ++element) {
            for_each_entry(element, [&](std::int32_t& holder, std::int32_t unknown, int) {
                if (holder == none) holder = unknown;
            });
        }
    });
    std::vector<std::uint32_t> apart(static_cast<std::size_t>(level.element_count()), 0);
    parallel_for_rows(level.element_count(), [&](std::int32_t element) {
        for_each_entry(element, [&](std::int32_t holder, std::int32_t unknown, int bit) {
            if (holder != unknown) apart[element] |= std::uint32_t{1} << bit;
        });
    });
    return apart;
}

}  // namespace

ElementSmoother::ElementSmoother(const Level& level, const ElementBlocks& blocks,
                                 const ElementPartition& partition)
    : level_(level),
      blocks_(blocks),
      partition_(partition),
      shares_(shares_of(level)),
      apart_(entries_apart(level, blocks)) {
    inverses_.resize(level.element_count());
    resize(movable_, level.unknown_count());
}

CoupledElements ElementSmoother::coupled(std::int32_t begin, std::int32_t end) const {
    return {level_.unknowns.front().data(), apart_.data(), begin, end};
}

void ElementSmoother::refresh(const MatrixBlocks& matrices, std::vector<Couplings>& workspace) {
    if (static_cast<std::int64_t>(workspace.size()) < level_.unknown_count()) {
        resize(workspace, level_.unknown_count());
    }
    parallel_for_rows(level_.unknown_count(),
                      [&](std::int32_t unknown) { workspace[unknown] = Couplings{}; });
    blocks_.for_each([&](std::int32_t begin, std::int32_t end) {
        kernels().sum_couplings(coupled(begin, end), matrices.blocks(), workspace.data());
    });
    parallel_for_rows(level_.unknown_count(), [&](std::int32_t unknown) {
        // What is not a number must not pass for a function that stays.
        movable_[unknown] = workspace[unknown].sum[0] <= kSmallestDiagonal ? 0 : 1;
    });
    parallel_for_blocks(level_.element_count(), [&](std::int64_t begin, std::int64_t end) {
        kernels().invert_locally(
            coupled(static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end)),
            matrices.blocks(), workspace.data(), shares_.data(), inverses_.blocks());
    });
}

void ElementSmoother::add_correction(float factor, const Field& residual, Field& x) const {
    correct(&x, factor, residual, x);
}

void ElementSmoother::correct(float factor, const Field& residual, Field& x) const {
    correct(nullptr, factor, residual, x);
}

double ElementSmoother::largest_eigenvalue(const MatrixBlocks& matrices) const {
    constexpr int steps = 12;
    Field x;
    Field product;
    x.resize(4, level_.unknown_count());
    parallel_for_rows(x.cols(), [&](std::int32_t unknown) {
        // Anything that has a part of every eigenvector.
        const auto hash = static_cast<std::uint32_t>(unknown) * 2654435761U;
        const float number = static_cast<float>(hash >> 8U) * 0x1p-23F - 1;
        x.col(unknown) << number, number * number - 0.3F, 1 - std::abs(number), 0;
        if (movable_[unknown] == 0) x.col(unknown).setZero();
    });
    double eigenvalue = 0;
    for (int step = 0; step < steps; ++step) {
        const double before = norm(x);
        if (!(before > 0) || !std::isfinite(before)) return 0;
        multiply(partition_, matrices, x, product);
        correct(static_cast<float>(1 / before), product, x);
        eigenvalue = norm(x);
    }
    return eigenvalue;
}

void ElementSmoother::correct(const Field* base, float factor, const Field& residual,
                              Field& x) const {
    partition_.sum(base, x, [&](const ElementRange& range, float* sum) {
        kernels().add_element_products(range, inverses_.blocks(), factor, residual.data(), sum);
        return 0.0;
    });
}

}  // namespace tracked_mcf
