#include "filter_tracked_mcf/core/sheets.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "filter_tracked_mcf/core/disjoint_sets.h"
#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

namespace {

/// Joins the fragments of one cell after the other.
class FragmentJoiner {
public:
    FragmentJoiner(const MeshTopology& topology, const std::vector<FragmentEntry>& fragments,
                   DisjointSets& sheets)
        : topology_(topology),
          fragments_(fragments),
          sheets_(sheets),
          last_with_vertex_(topology.welded.size(), kNone),
          last_with_edge_(static_cast<std::size_t>(topology.edge_count), kNone) {}

    /// Joins the fragments from begin to end, all those of a cell.
    void join(std::int32_t begin, std::int32_t end) {
        for (std::int32_t i = begin; i < end; ++i) {
            const FragmentEntry& fragment = fragments_[i];
            const Triangle& vertices = topology_.triangles[fragment.triangle];
            const auto& edges = topology_.edges[fragment.triangle];
            for (int k = 0; k < 3; ++k) {
                if (((fragment.corners >> k) & 1) != 0) {
                    join(last_with_vertex_[vertices[k]], i, begin, end);
                }
                if (((fragment.edges >> k) & 1) != 0 && edges[k] != MeshTopology::kNoEdge) {
                    join(last_with_edge_[edges[k]], i, begin, end);
                }
            }
        }
    }

private:
    static constexpr std::int32_t kNone = -1;

    /// Joins a fragment to the last one that had the same vertex or edge, if that was in this cell.
    void join(std::int32_t& last, std::int32_t fragment, std::int32_t cell_begin,
              std::int32_t cell_end) {
        if (last >= cell_begin && last < cell_end) sheets_.unite(last, fragment);
        last = fragment;
    }

    const MeshTopology& topology_;
    const std::vector<FragmentEntry>& fragments_;
    DisjointSets& sheets_;
    std::vector<std::int32_t> last_with_vertex_;
    std::vector<std::int32_t> last_with_edge_;
};

/// Of every fragment the first fragment of its sheet.
std::vector<std::int32_t> find_sheets(const MeshTopology& topology,
                                      const std::vector<FragmentEntry>& fragments,
                                      const FinestElements& cells) {
    DisjointSets sheets(static_cast<std::int32_t>(fragments.size()));
    const auto count = static_cast<std::int64_t>(cells.cells.size());
    parallel_for_blocks_with(
        count, [&] { return FragmentJoiner(topology, fragments, sheets); },
        [&](FragmentJoiner& joiner, std::int64_t begin, std::int64_t end) {
            Pacer pacer;
            for (std::int64_t cell = begin; cell < end; ++cell) {
                const std::int64_t first = cells.fragment_begin[cell];
                const std::int64_t last = cells.fragment_begin[cell + 1];
                joiner.join(static_cast<std::int32_t>(first), static_cast<std::int32_t>(last));
                pacer.did(last - first);
            }
        });
    return std::move(sheets).representatives();
}

/// Sorts the fragments from begin to end, those of a cell, by sheet.
void sort_by_sheet(std::vector<FragmentEntry>& fragments, std::vector<std::int32_t>& sheets,
                   std::int64_t begin, std::int64_t end) {
    if (std::is_sorted(sheets.begin() + begin, sheets.begin() + end)) return;
    std::vector<std::pair<std::int32_t, FragmentEntry>> labelled;
    for (std::int64_t i = begin; i < end; ++i) labelled.emplace_back(sheets[i], fragments[i]);
    std::stable_sort(labelled.begin(), labelled.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::int64_t i = begin; i < end; ++i) {
        std::tie(sheets[i], fragments[i]) = labelled[i - begin];
    }
}

/// Consecutive fragments i with the same label(i) become one element.
template <class Label>
FinestElements group_fragments(const std::vector<FragmentEntry>& fragments, const Label& label) {
    FinestElements elements;
    serial_for(static_cast<std::int64_t>(fragments.size()), [&](std::int64_t i) {
        if (i > 0 && label(i) == label(i - 1)) return;
        elements.cells.push_back(fragments[i].cell);
        elements.fragment_begin.push_back(i);
    });
    elements.fragment_begin.push_back(static_cast<std::int64_t>(fragments.size()));
    return elements;
}

}  // namespace

FinestElements one_element_per_cell(const std::vector<FragmentEntry>& fragments) {
    return group_fragments(fragments, [&](std::int64_t i) { return fragments[i].cell; });
}

FinestElements separate_sheets(const MeshTopology& topology,
                               std::vector<FragmentEntry>& fragments) {
    if (fragments.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
        throw InvalidParameter("The octree is too deep for this mesh; choose a smaller depth.");
    }
    const FinestElements cells = one_element_per_cell(fragments);
    std::vector<std::int32_t> sheets = find_sheets(topology, fragments, cells);
    const auto count = static_cast<std::int64_t>(cells.cells.size());
    parallel_for_blocks(count, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t cell = begin; cell < end; ++cell) {
            sort_by_sheet(fragments, sheets, cells.fragment_begin[cell],
                          cells.fragment_begin[cell + 1]);
        }
    });
    return group_fragments(fragments, [&](std::int64_t i) { return sheets[i]; });
}

}  // namespace tracked_mcf
