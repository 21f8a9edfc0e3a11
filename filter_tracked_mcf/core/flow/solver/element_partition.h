// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow/kernels/element_products.h"
#include "filter_tracked_mcf/core/flow/octree/octree.h"
#include "filter_tracked_mcf/core/flow/solver/field.h"
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

    /// Sets the result to the base, and adds the contributions of all subsets by calling
    /// contribute(range, result's data). A null base is zero; the base may be the result itself.
    /// contribute() may access the result only to add to targets.
    template <class Contribute>
    void sum(const Field* base, Field& result, const Contribute& contribute) const {
        result.resize(4, level_.unknown_count());
        const auto contribute_subset = [&](std::int64_t i) {
            initialize(subsets_[i], base, result);
            contribute(range(subsets_[i]), result.data());
        };
        parallel_for(static_cast<std::int64_t>(subsets_.size()), contribute_subset,
                     kSubsetsWorthThreads);
        add_slots(result);
    }

private:
    /// Number of elements per subset: the columns of their unknowns fit into a second-level cache.
    static constexpr std::int32_t kSubsetSize = 4096;
    static_assert(kSubsetSize % kBlockElements == 0);

    /// With this many subsets or more, threads save more time than they cost.
    static constexpr std::int64_t kSubsetsWorthThreads = 4;

    /// An unknown of several subsets. Its slots are shared_slots_[begin] to shared_slots_[end - 1].
    struct Shared {
        std::int32_t unknown;
        std::int64_t begin, end;
    };

    struct Subset {
        std::int32_t begin, end;                  ///< elements
        std::int32_t unknown_begin, unknown_end;  ///< unknowns that it owns
        std::int32_t slot_begin, slot_end;        ///< slots for unknowns of earlier subsets
    };

    void find_subsets();
    void assign_slots();
    void initialize(const Subset& subset, const Field* base, Field& result) const;
    void add_slots(Field& result) const;
    ElementRange range(const Subset& subset) const;

    const Level& level_;
    std::vector<Subset> subsets_;
    std::vector<std::int64_t> target_offsets_;  ///< see ElementRange
    std::vector<std::int32_t> targets_;
    std::vector<Shared> shared_;
    std::vector<std::int32_t> shared_slots_;
    mutable Field slots_;  ///< workspace of sum()
};

/// Returns the addresses of the eight targets of an element; `sums` is the result's data.
inline std::array<float*, 8> targets_of(const ElementRange& range, std::int32_t element,
                                        float* sums) {
    const std::int64_t offset = range.target_offsets[element / kBlockElements];
    const std::int32_t* const targets =
        offset == ElementRange::kDirect ? range.unknowns + std::int64_t{8} * element
                                        : range.targets + offset + 8 * (element % kBlockElements);
    std::array<float*, 8> addresses;
    for (int i = 0; i < 8; ++i) {
        const std::int64_t target = targets[i];
        addresses[i] = target >= 0 ? sums + 4 * target : range.slots + 4 * (-1 - target);
    }
    return addresses;
}

}  // namespace tracked_mcf
