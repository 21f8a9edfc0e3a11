#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/field.h"
#include "filter_tracked_mcf/core/kernels/element_products.h"
#include "filter_tracked_mcf/core/octree.h"
#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

/// A level's elements, cut into parts of consecutive ones that threads work on at once, for sums
/// over elements of what they contribute to their unknowns. An unknown belongs to the first part
/// that has it, so the unknowns of a part are consecutive, too. What other parts contribute to it
/// goes to slots and is added afterwards, in the order of the parts. Parts do not depend on the
/// number of threads, so the bits do not either.
class ElementPartition {
public:
    /// `level` must outlive this.
    explicit ElementPartition(const Level& level);

    /// result = base + Σ_parts what contribute(range, result's data) adds, which returns a number:
    /// returns their sum. A base that is null is zero; it may be the result itself. `contribute`
    /// may read the result nowhere else than where it adds.
    template <class Contribute>
    double sum(const Field* base, Field& result, const Contribute& contribute) const;

private:
    /// Elements of a part: their unknowns' columns fit in a second-level cache.
    static constexpr std::int32_t kPartSize = 4096;
    static_assert(kPartSize % kBlockElements == 0);

    /// Parts that outweigh waking and joining threads.
    static constexpr std::int64_t kPartsWorthThreads = 4;

    /// An unknown that several parts have, and its slots: from begin to end in shared_slots_.
    struct Shared {
        std::int32_t unknown;
        std::int64_t begin, end;
    };

    struct Part {
        std::int32_t begin, end;                  ///< elements
        std::int32_t unknown_begin, unknown_end;  ///< its own
        std::int32_t slot_begin, slot_end;        ///< for unknowns of other parts
    };

    void find_parts();
    void send_elsewhere();
    bool owns_all(const Part& part, std::int32_t first) const;
    void open(const Part& part, const Field* base, Field& result) const;
    void add_slots(Field& result) const;
    ElementRange range(const Part& part) const;

    const Level& level_;
    std::vector<Part> parts_;
    std::vector<std::int64_t> detours_;  ///< see ElementRange
    std::vector<std::int32_t> targets_;
    std::vector<Shared> shared_;
    std::vector<std::int32_t> shared_slots_;
    mutable Field slots_;  ///< filled and emptied by every sum
};

template <class Contribute>
double ElementPartition::sum(const Field* base, Field& result, const Contribute& contribute) const {
    result.resize(4, level_.unknown_count());
    std::vector<double> numbers(parts_.size());
    parallel_for(
        static_cast<std::int64_t>(parts_.size()),
        [&](std::int64_t i) {
            const Part& part = parts_[static_cast<std::size_t>(i)];
            open(part, base, result);
            numbers[static_cast<std::size_t>(i)] = contribute(range(part), result.data());
        },
        kPartsWorthThreads);
    add_slots(result);
    return std::accumulate(numbers.begin(), numbers.end(), 0.0);
}

}  // namespace tracked_mcf
