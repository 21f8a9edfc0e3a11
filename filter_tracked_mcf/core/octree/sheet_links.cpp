// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/octree/sheet_links.h"

#include <algorithm>
#include <array>

#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/sorting.h"

namespace tracked_mcf {

namespace {

/// The part of a triangle, an edge or a vertex in one element.
struct Piece {
    std::int32_t element;
    MortonCode code;
    Cell cell;
};

/// Returns the number of faces that one crosses from the cell `a` to the cell `b`.
int steps_between(const Cell& a, const Cell& b) {
    return (b - a).cwiseAbs().sum();
}

/// Links pieces in touching cells. Leaves out most copies of a link before they take memory, since
/// neighbouring triangles yield the same links again and again.
class LinkCollector {
public:
    /// Links are appended to `links`.
    explicit LinkCollector(std::vector<Link>& links) : links_(links) { recent_.fill({-1, -1}); }

    /// Links all pieces in touching cells, directly or through pieces that touch both cells. The
    /// pieces belong to one triangle, edge or vertex. They lie in different cells and are sorted by
    /// cell.
    void link_touching(const std::vector<Piece>& pieces) {
        if (pieces.size() < kWorthSearching) {
            link_pairs(pieces);
        } else {
            link_neighbours(pieces);
        }
    }

private:
    static constexpr std::size_t kWorthSearching = 64;
    static constexpr std::size_t kRecent = 1024;

    /// Compares all pairs of pieces.
    void link_pairs(const std::vector<Piece>& pieces) {
        for (auto second = pieces.begin(); second != pieces.end(); ++second) {
            for (auto first = pieces.begin(); first != second; ++first) {
                const Cell offset = second->cell - first->cell;
                if (offset.cwiseAbs().maxCoeff() > 1) continue;
                const int steps = steps_between(first->cell, second->cell);
                // A piece one step on the way makes the link unnecessary: its cell touches both
                // cells at all corners that they share.
                const auto on_the_way = [&](const Piece& piece) {
                    return steps_between(first->cell, piece.cell) == 1 &&
                           steps_between(piece.cell, second->cell) == steps - 1;
                };
                if (steps > 1 && std::any_of(pieces.begin(), pieces.end(), on_the_way)) continue;
                add(first->element, second->element);
            }
        }
    }

    /// Searches the pieces for the neighbours of each cell.
    void link_neighbours(const std::vector<Piece>& pieces) {
        for (auto piece = pieces.begin(); piece != pieces.end(); ++piece) {
            for (int direction = 0; direction < 27; ++direction) {
                const Cell offset(direction % 3 - 1, direction / 3 % 3 - 1, direction / 9 - 1);
                const Cell cell = piece->cell + offset;
                if (cell.minCoeff() < 0) continue;
                const MortonCode code = morton_code(cell);
                if (code <= piece->code) continue;  // the pair is linked from the other piece
                const auto found = std::lower_bound(
                    piece, pieces.end(), code,
                    [](const Piece& other, MortonCode wanted) { return other.code < wanted; });
                if (found == pieces.end() || found->code != code) continue;
                add(piece->element, found->element);
            }
        }
    }

    void add(std::int32_t first, std::int32_t second) {
        const auto hash = static_cast<std::size_t>(first) * 31 + static_cast<std::size_t>(second);
        Link& recent = recent_[hash % kRecent];
        if (recent.first == first && recent.second == second) return;
        recent = {first, second};
        links_.push_back(recent);
    }

    std::vector<Link>& links_;
    std::array<Link, kRecent> recent_;
};

/// Returns, as bit `axis`, whether the point lies in a grid plane across that axis.
unsigned planes_at(const Eigen::Vector3d& point) {
    unsigned planes = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (point[axis] == static_cast<std::int32_t>(point[axis])) planes |= 1U << axis;
    }
    return planes;
}

/// Returns whether both points lie in the same grid plane.
bool share_plane(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const unsigned planes = planes_at(a) & planes_at(b);
    for (int axis = 0; axis < 3; ++axis) {
        if (has_bit(planes, axis) && a[axis] == b[axis]) return true;
    }
    return false;
}

/// A fragment and its element.
struct ElementFragment {
    std::int32_t triangle, element;
    std::uint8_t corners, edges;  ///< as in FragmentEntry
};

/// Returns the fragments sorted by triangle.
RawVector<ElementFragment> sorted_by_triangle(const RawVector<FragmentEntry>& fragments,
                                              const FinestElements& elements) {
    RawVector<ElementFragment> sorted(fragments.size());
    const auto count = static_cast<std::int64_t>(elements.cells.size());
    parallel_for_chunks(count, [&](std::int64_t begin, std::int64_t end) {
        auto element = static_cast<std::int32_t>(begin);
        for (std::int64_t i = elements.fragment_begin[begin]; i < elements.fragment_begin[end];
             ++i) {
            if (i == elements.fragment_begin[element + 1]) ++element;
            const FragmentEntry& fragment = fragments[i];
            sorted[fragment.index_by_triangle] = {fragment.triangle, element,
                                                  static_cast<std::uint8_t>(fragment.corners),
                                                  static_cast<std::uint8_t>(fragment.edges)};
        }
    });
    return sorted;
}

/// Finds the pieces of triangles, edges and vertices, and links them.
class LinkFinder {
    auto begins_triangle() const {
        return runs_by(fragments_,
                       [](const ElementFragment& fragment) { return fragment.triangle; });
    }

public:
    LinkFinder(const GridMesh& mesh, const MeshTopology& topology,
               const RawVector<FragmentEntry>& fragments, const FinestElements& elements)
        : mesh_(mesh),
          topology_(topology),
          elements_(elements),
          fragments_(sorted_by_triangle(fragments, elements)) {}

    /// Returns the links that triangles make.
    RawVector<Link> through_triangles() const {
        return link_runs(static_cast<std::int64_t>(fragments_.size()), begins_triangle(),
                         [this](std::int64_t i) { return fragments_[i].element; });
    }

    /// Returns the links that edges and vertices in grid planes make.
    RawVector<Link> through_edges_and_vertices() const {
        const RawVector<KeyValue> pieces = pieces_in_planes();
        return link_runs(
            static_cast<std::int64_t>(pieces.size()),
            runs_by(pieces, [](const KeyValue& piece) { return piece.key; }),
            [&](std::int64_t i) { return static_cast<std::int32_t>(pieces[i].value); });
    }

private:
    /// Finding the links of a piece takes as long as this many light items.
    static constexpr std::int64_t kItemsPerPiece = 32;

    /// Returns the links of each run of items. The items i of a run are the pieces of one triangle,
    /// edge or vertex, in the elements element_of(i).
    template <class Begins, class ElementOf>
    RawVector<Link> link_runs(std::int64_t count, const Begins& begins,
                              const ElementOf& element_of) const {
        return parallel_collect_runs<Link, RawVector<Link>>(
            count, begins, [&](std::int64_t begin, std::int64_t end, std::vector<Link>& out) {
                LinkCollector collector(out);
                std::vector<std::int32_t> elements;
                std::vector<Piece> pieces;
                Pacer pacer;
                for_each_run(begin, end, begins, [&](std::int64_t first, std::int64_t last) {
                    pacer.did(kItemsPerPiece * (last - first));
                    if (last - first < 2) return;
                    elements.clear();
                    for (std::int64_t i = first; i < last; ++i) elements.push_back(element_of(i));
                    std::sort(elements.begin(), elements.end());
                    elements.erase(std::unique(elements.begin(), elements.end()), elements.end());
                    pieces.clear();
                    for (const std::int32_t element : elements) {
                        const MortonCode code = elements_.cells[element];
                        pieces.push_back({element, code, cell_at(code)});
                    }
                    collector.link_touching(pieces);
                });
            });
    }

    /// Returns the pieces of edges and vertices in grid planes, sorted by key. The value of a piece
    /// is its element. The key of an edge is its number, the key of a vertex is edge_count plus its
    /// number.
    RawVector<KeyValue> pieces_in_planes() const {
        const auto begins = begins_triangle();
        auto pieces = parallel_collect_runs<KeyValue, RawVector<KeyValue>>(
            static_cast<std::int64_t>(fragments_.size()), begins,
            [&](std::int64_t begin, std::int64_t end, std::vector<KeyValue>& out) {
                for_each_run(begin, end, begins, [&](std::int64_t first, std::int64_t last) {
                    add_pieces_in_planes(first, last, out);
                });
            });
        sort_by_key(pieces);
        return pieces;
    }

    /// Appends the pieces of the edges and vertices of the triangle with the fragments [first,
    /// last).
    void add_pieces_in_planes(std::int64_t first, std::int64_t last,
                              std::vector<KeyValue>& out) const {
        const std::int32_t triangle = fragments_[first].triangle;
        const auto corners = mesh_.corners(triangle);
        const auto add_pieces = [&](std::int64_t key, std::uint8_t ElementFragment::*flags, int i) {
            for (std::int64_t fragment = first; fragment < last; ++fragment) {
                if (!has_bit(fragments_[fragment].*flags, i)) continue;
                out.push_back({static_cast<std::uint64_t>(key),
                               static_cast<std::uint64_t>(fragments_[fragment].element)});
            }
        };
        for (int i = 0; i < 3; ++i) {
            if (planes_at(corners[i]) == 0) continue;
            const std::int64_t vertex = topology_.triangles[triangle][i];
            add_pieces(topology_.edge_count + vertex, &ElementFragment::corners, i);
            const std::int32_t edge = topology_.edges[triangle][i];
            if (edge == MeshTopology::kNoEdge || !share_plane(corners[i], corners[(i + 1) % 3])) {
                continue;
            }
            add_pieces(edge, &ElementFragment::edges, i);
        }
    }

    const GridMesh& mesh_;
    const MeshTopology& topology_;
    const FinestElements& elements_;
    RawVector<ElementFragment> fragments_;
};

}  // namespace

RawVector<Link> find_links(const GridMesh& mesh, const MeshTopology& topology,
                           const RawVector<FragmentEntry>& fragments,
                           const FinestElements& elements) {
    const LinkFinder finder(mesh, topology, fragments, elements);
    RawVector<Link> links = finder.through_triangles();
    const RawVector<Link> others = finder.through_edges_and_vertices();
    links.insert(links.end(), others.begin(), others.end());
    sort_and_remove_copies(links, static_cast<std::int32_t>(elements.cells.size()));
    return links;
}

}  // namespace tracked_mcf
