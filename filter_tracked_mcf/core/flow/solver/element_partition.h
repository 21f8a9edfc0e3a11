// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow/octree/octree.h"
#include "filter_tracked_mcf/core/flow/solver/field.h"
#include "filter_tracked_mcf/core/flow/system/matrix_blocks.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

/// A level's elements, cut into subsets of consecutive elements. Threads sum the contributions of
/// elements to their unknowns subset by subset. The first subset that has an unknown owns it, so a
/// subset owns consecutive unknowns. Contributions of other subsets go to slots, and the slots are
/// added afterwards in the order of the subsets. Subsets do not depend on the number of threads, so
/// neither do the bits.
class ElementPartition {
public:
    /// `level` must outlive this.
    explicit ElementPartition(const Level& level);

    /// Sets the result to the base, and adds the contributions of all elements by calling
    /// contribute(element, at): at(unknown) is the column to add to. A null base is zero; the base
    /// may be the result itself.
    template <class Contribute>
    void sum(const Field* base, Field& result, const Contribute& contribute) const {
        result.resize(4, level_.unknown_count());
        const auto contribute_subset = [&](std::int64_t i) {
            const Subset& subset = subsets_[i];
            initialize(subset, base, result);
            const auto at = [&](std::int32_t unknown) {
                return unknown >= subset.unknown_begin ? result.col(unknown)
                                                       : slots_.col(slot_of(subset, unknown));
            };
            for (std::int32_t element = subset.begin; element < subset.end; ++element)
                contribute(element, at);
        };
        parallel_for(static_cast<std::int64_t>(subsets_.size()), contribute_subset,
                     kSubsetsWorthThreads);
        for (Eigen::Index slot = 0; slot < slots_.cols(); ++slot)
            result.col(unknown_of_slot_[slot]) += slots_.col(slot);
    }

    /// Computes result = base + factor Σ_e R_eᵀ M_e R_e x with these element matrices M_e, where
    /// R_e selects an element's eight unknowns. The base as in sum().
    void add_products(const MatrixBlocks& matrices, float factor, const Field& x, const Field* base,
                      Field& result) const;

private:
    /// Number of elements per subset: the columns of their unknowns fit into a second-level cache.
    static constexpr std::int32_t kSubsetSize = 4096;

    /// With this many subsets or more, threads save more time than they cost.
    static constexpr std::int64_t kSubsetsWorthThreads = 4;

    struct Subset {
        std::int32_t begin, end;                  ///< elements
        std::int32_t unknown_begin, unknown_end;  ///< unknowns that it owns
        std::int64_t slot_begin, slot_end;        ///< slots for unknowns of earlier subsets
    };

    void initialize(const Subset& subset, const Field* base, Field& result) const;
    std::int64_t slot_of(const Subset& subset, std::int32_t unknown) const {
        const auto first = unknown_of_slot_.begin();
        return std::lower_bound(first + subset.slot_begin, first + subset.slot_end, unknown) -
               first;
    }

    const Level& level_;
    std::vector<Subset> subsets_;
    std::vector<std::int32_t> unknown_of_slot_;  ///< increasing within a subset
    mutable Field slots_;                        ///< workspace of sum()
};

}  // namespace tracked_mcf
