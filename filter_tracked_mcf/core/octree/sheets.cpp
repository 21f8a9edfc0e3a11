// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/octree/sheets.h"

#include <algorithm>
#include <utility>

#include "filter_tracked_mcf/core/parallel/disjoint_sets.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// Returns elements that begin at the fragments i with begins(i).
template <class Begins>
FinestElements group_fragments(const RawVector<FragmentEntry>& fragments, const Begins& begins) {
    const auto count = static_cast<std::int64_t>(fragments.size());
    FinestElements elements;
    elements.fragment_begin =
        parallel_collect_if<std::int64_t>(count, begins, [](std::int64_t i) { return i; });
    elements.cells.resize(elements.fragment_begin.size());
    parallel_for_rows(static_cast<std::int64_t>(elements.cells.size()), [&](std::int32_t element) {
        elements.cells[element] = fragments[elements.fragment_begin[element]].cell;
    });
    elements.fragment_begin.push_back(count);
    return elements;
}

/// The last fragment of a cell with each key. A hash table with linear probing: an entry whose
/// fragment is not one of the cell's is empty, so the table need not be cleared for the next cell.
class LastFragments {
public:
    /// Prepares the table for the cell of the fragments [begin, end). Each has at most six keys.
    void start(std::int32_t begin, std::int32_t end) {
        begin_ = begin;
        end_ = end;
        size_ = std::uint64_t{8} * static_cast<std::uint64_t>(end - begin);
        if (entries_.size() < size_) entries_.resize(size_);
    }

    /// Makes `fragment` the last one with the key. Returns the one before it, or kNone.
    std::int32_t exchange(std::uint32_t key, std::int32_t fragment) {
        const std::uint32_t hash = key * 0x9E3779B1U;  // 2^32 over the golden ratio
        for (std::uint64_t i = hash * size_ >> 32U;; i = i + 1 < size_ ? i + 1 : 0) {
            Entry& entry = entries_[i];
            const bool empty = entry.fragment < begin_ || entry.fragment >= end_;
            if (!empty && entry.key != key) continue;
            entry.key = key;
            const std::int32_t last = std::exchange(entry.fragment, fragment);
            return empty ? kNone : last;
        }
    }

    static constexpr std::int32_t kNone = -1;

private:
    struct Entry {
        std::uint32_t key = 0;
        std::int32_t fragment = kNone;
    };

    std::int32_t begin_ = 0, end_ = 0;
    std::uint64_t size_ = 0;  ///< entries of this cell; the largest cell so far may have had more
    std::vector<Entry> entries_;
};

/// Finds the sheets of one cell at a time.
class SheetFinder {
public:
    SheetFinder(const MeshTopology& topology, RawVector<FragmentEntry>& fragments)
        : topology_(topology), fragments_(fragments) {}

    /// Sorts the fragments [begin, end) of a cell by sheet and flags the first fragment of each
    /// sheet in `begins_sheet`.
    void separate(std::int64_t begin, std::int64_t end, std::vector<std::uint8_t>& begins_sheet) {
        begins_sheet[begin] = 1;
        if (are_one_sheet(static_cast<std::int32_t>(begin), static_cast<std::int32_t>(end))) return;
        labelled_.clear();
        for (std::int64_t i = begin; i < end; ++i) {
            const std::int32_t sheet = sheets_.find(static_cast<std::int32_t>(i - begin));
            labelled_.emplace_back(sheet, fragments_[i]);
        }
        std::stable_sort(labelled_.begin(), labelled_.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        for (std::int64_t i = begin; i < end; ++i) {
            const auto& [sheet, fragment] = labelled_[i - begin];
            fragments_[i] = fragment;
            if (i > begin) begins_sheet[i] = sheet != labelled_[i - begin - 1].first ? 1 : 0;
        }
    }

private:
    /// Distinguishes the key of an edge from that of a vertex.
    static constexpr std::uint32_t kEdge = std::uint32_t{1} << 31U;

    /// Joins the fragments [begin, end) of a cell in sheets_. Returns true, and stops, as soon as
    /// they are one sheet.
    bool are_one_sheet(std::int32_t begin, std::int32_t end) {
        sheets_.reset(end - begin);
        last_.start(begin, end);
        std::int32_t sheet_count = end - begin;
        const auto join = [&](std::uint32_t key, std::int32_t fragment) {
            const std::int32_t other = last_.exchange(key, fragment);
            if (other == LastFragments::kNone) return;
            if (sheets_.unite(other - begin, fragment - begin)) --sheet_count;
        };
        // Most cells are one sheet by their vertices alone.
        for (std::int32_t i = begin; i < end && sheet_count > 1; ++i) {
            const Triangle& vertices = topology_.triangles[fragments_[i].triangle];
            for (int k = 0; k < 3; ++k) {
                if (has_bit(fragments_[i].corners, k))
                    join(static_cast<std::uint32_t>(vertices[k]), i);
            }
        }
        for (std::int32_t i = begin; i < end && sheet_count > 1; ++i) {
            const auto& edges = topology_.edges[fragments_[i].triangle];
            for (int k = 0; k < 3; ++k) {
                if (has_bit(fragments_[i].edges, k) && edges[k] != MeshTopology::kNoEdge)
                    join(kEdge | static_cast<std::uint32_t>(edges[k]), i);
            }
        }
        return sheet_count == 1;
    }

    const MeshTopology& topology_;
    RawVector<FragmentEntry>& fragments_;
    DisjointSets sheets_{0};  ///< of the cell's fragments, numbered from 0
    LastFragments last_;
    std::vector<std::pair<std::int32_t, FragmentEntry>> labelled_;
};

}  // namespace

FinestElements one_element_per_cell(const RawVector<FragmentEntry>& fragments) {
    return group_fragments(fragments,
                           runs_by(fragments, [](const FragmentEntry& fragment) -> MortonCode {
                               return fragment.cell;
                           }));
}

FinestElements separate_sheets(const MeshTopology& topology, RawVector<FragmentEntry>& fragments) {
    const FinestElements cells = one_element_per_cell(fragments);
    std::vector<std::uint8_t> begins_sheet(fragments.size(), 0);
    parallel_for_chunks_with(
        static_cast<std::int64_t>(cells.cells.size()),
        [&] { return SheetFinder(topology, fragments); },
        [&](SheetFinder& finder, std::int64_t begin, std::int64_t end) {
            Pacer pacer;
            for (std::int64_t cell = begin; cell < end; ++cell) {
                const std::int64_t first = cells.fragment_begin[cell];
                const std::int64_t last = cells.fragment_begin[cell + 1];
                finder.separate(first, last, begins_sheet);
                pacer.did(last - first);
            }
        });
    return group_fragments(fragments, [&](std::int64_t i) { return begins_sheet[i] != 0; });
}

}  // namespace tracked_mcf
