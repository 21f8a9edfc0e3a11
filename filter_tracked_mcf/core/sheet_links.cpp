#include "filter_tracked_mcf/core/sheet_links.h"

#include <algorithm>
#include <array>

#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/sorting.h"

namespace tracked_mcf {

namespace {

/// Where a triangle, edge or vertex has a piece.
struct Piece {
    std::int32_t element;
    MortonCode code;
    Cell cell;
};

/// The faces of a cell through which one gets nearer to the cell at this offset: two bits an axis.
int faces_towards(const Cell& offset) {
    int faces = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (offset[axis] < 0) faces |= 1 << (2 * axis);
        if (offset[axis] > 0) faces |= 2 << (2 * axis);
    }
    return faces;
}

/// Appends links to a vector, without most of the copies: neighbouring triangles ask for the same
/// links again and again.
class LinkCollector {
public:
    explicit LinkCollector(std::vector<Link>& links) : links_(links) { recent_.fill({-1, -1}); }

    /// Links all pieces in touching cells, directly or by way of others that touch both of them.
    /// Pieces are sorted by cell, each cell once.
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

    /// Two cells that share no face, but an edge or a corner.
    struct Diagonal {
        std::size_t first, second;
        int faces;  ///< of the first, towards the second
    };

    void link_pairs(const std::vector<Piece>& pieces) {
        faces_.assign(pieces.size(), 0);
        diagonals_.clear();
        for (std::size_t i = 1; i < pieces.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                const Cell offset = pieces[i].cell - pieces[j].cell;
                const auto distance = offset.cwiseAbs();
                if (distance.maxCoeff() > 1) continue;
                if (distance.sum() > 1) {
                    diagonals_.push_back({j, i, faces_towards(offset)});
                    continue;
                }
                faces_[i] |= faces_towards(-offset);
                faces_[j] |= faces_towards(offset);
                add(pieces[j].element, pieces[i].element);
            }
        }
        // A piece in between, behind a face of the first cell, does: it touches both cells, and at
        // all corners that these share.
        for (const Diagonal& pair : diagonals_) {
            if ((faces_[pair.first] & pair.faces) != 0) continue;
            add(pieces[pair.first].element, pieces[pair.second].element);
        }
    }

    void link_neighbours(const std::vector<Piece>& pieces) {
        for (auto piece = pieces.begin(); piece != pieces.end(); ++piece) {
            for (int direction = 0; direction < 27; ++direction) {
                const Cell offset(direction % 3 - 1, direction / 3 % 3 - 1, direction / 9 - 1);
                const Cell cell = piece->cell + offset;
                if (cell.minCoeff() < 0) continue;
                const MortonCode code = morton_code(cell);
                if (code <= piece->code) continue;  // linked from the other side
                const auto found = std::lower_bound(
                    piece, pieces.end(), code,
                    [](const Piece& other, MortonCode wanted) { return other.code < wanted; });
                if (found == pieces.end() || found->code != code) continue;
                add(piece->element, found->element);
            }
        }
    }

    void add(std::int32_t first, std::int32_t second) {
        const auto slot = static_cast<std::size_t>(first) * 31 + static_cast<std::size_t>(second);
        Link& recent = recent_[slot % kRecent];
        if (recent.first == first && recent.second == second) return;
        recent = {first, second};
        links_.push_back(recent);
    }

    std::vector<Link>& links_;
    std::array<Link, kRecent> recent_;
    std::vector<int> faces_;  ///< of every piece's cell, those with another piece behind them
    std::vector<Diagonal> diagonals_;
};

/// Bit `axis` is set if the point lies in a grid plane across that axis.
int planes_at(const Eigen::Vector3d& point) {
    int planes = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (point[axis] == static_cast<std::int32_t>(point[axis])) planes |= 1 << axis;
    }
    return planes;
}

/// Whether both points lie in the same grid plane.
bool share_plane(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    const int planes = planes_at(a) & planes_at(b);
    for (int axis = 0; axis < 3; ++axis) {
        if (((planes >> axis) & 1) != 0 && a[axis] == b[axis]) return true;
    }
    return false;
}

/// A fragment in the order of triangles.
struct PlacedFragment {
    std::int32_t triangle, element;
    std::uint8_t corners, edges;  ///< as in FragmentEntry
};

RawVector<PlacedFragment> by_triangle(const RawVector<FragmentEntry>& fragments,
                                      const FinestElements& elements) {
    RawVector<PlacedFragment> placed(fragments.size());
    const auto place = [&](std::int64_t i, std::int64_t element) {
        const FragmentEntry& fragment = fragments[i];
        placed[fragment.place] = {fragment.triangle, static_cast<std::int32_t>(element),
                                  static_cast<std::uint8_t>(fragment.corners),
                                  static_cast<std::uint8_t>(fragment.edges)};
    };
    const auto count = static_cast<std::int64_t>(elements.cells.size());
    parallel_for_blocks(count, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t element = begin; element < end; ++element) {
            for (std::int64_t i = elements.fragment_begin[element];
                 i < elements.fragment_begin[element + 1]; ++i) {
                place(i, element);
            }
        }
    });
    return placed;
}

/// Whether a fragment is the first of its triangle.
struct BeginsTriangle {
    const RawVector<PlacedFragment>& fragments;

    bool operator()(std::int64_t i) const {
        return i == 0 || fragments[i].triangle != fragments[i - 1].triangle;
    }
};

/// Finds pieces and has them linked.
class LinkFinder {
public:
    LinkFinder(const GridMesh& mesh, const MeshTopology& topology,
               const RawVector<FragmentEntry>& fragments, const FinestElements& elements)
        : mesh_(mesh),
          topology_(topology),
          elements_(elements),
          fragments_(by_triangle(fragments, elements)) {}

    /// Links made by triangles.
    RawVector<Link> through_triangles() const {
        const auto visit = [this](LinkCollector& collector, std::vector<Piece>& pieces,
                                  std::int64_t first, std::int64_t last) {
            if (last - first < 2) return;
            pieces.clear();
            for (std::int64_t i = first; i < last; ++i) {
                pieces.push_back(piece_of(fragments_[i].element));
            }
            sort_and_remove_copies(pieces);
            collector.link_touching(pieces);
        };
        return collect_links(static_cast<std::int64_t>(fragments_.size()),
                             BeginsTriangle{fragments_}, visit);
    }

    /// Links made by edges and vertices that lie in grid planes.
    RawVector<Link> through_edges_and_vertices() const {
        const RawVector<KeyValue> pieces_of = sorted_pieces();
        const auto visit = [&](LinkCollector& collector, std::vector<Piece>& pieces,
                               std::int64_t first, std::int64_t last) {
            pieces.clear();
            for (std::int64_t i = first; i < last; ++i) {
                pieces.push_back(piece_of(static_cast<std::int32_t>(pieces_of[i].value)));
            }
            sort_and_remove_copies(pieces);
            collector.link_touching(pieces);
        };
        const auto begins = [&](std::int64_t i) {
            return i == 0 || pieces_of[i].key != pieces_of[i - 1].key;
        };
        return collect_links(static_cast<std::int64_t>(pieces_of.size()), begins, visit);
    }

private:
    /// Light items that looking for a piece's links takes as long as.
    static constexpr std::int64_t kItemsPerPiece = 32;

    /// What visit(collector, room, first, last) collects for every run of items, in parallel.
    template <class Begins, class Visit>
    static RawVector<Link> collect_links(std::int64_t count, const Begins& begins,
                                         const Visit& visit) {
        return parallel_collect_runs<Link, RawVector<Link>>(
            count, begins, [&](std::int64_t begin, std::int64_t end, std::vector<Link>& out) {
                LinkCollector collector(out);
                std::vector<Piece> pieces;
                Pacer pacer;
                for_each_run(begin, end, begins, [&](std::int64_t first, std::int64_t last) {
                    visit(collector, pieces, first, last);
                    pacer.did(kItemsPerPiece * (last - first));
                });
            });
    }

    Piece piece_of(std::int32_t element) const {
        const MortonCode code = elements_.cells[element];
        return {element, code, cell_at(code)};
    }

    static void sort_and_remove_copies(std::vector<Piece>& pieces) {
        std::sort(pieces.begin(), pieces.end(),
                  [](const Piece& a, const Piece& b) { return a.element < b.element; });
        const auto same = [](const Piece& a, const Piece& b) { return a.element == b.element; };
        pieces.erase(std::unique(pieces.begin(), pieces.end(), same), pieces.end());
    }

    /// Of every edge (key: its number) and vertex (key: after all edges) in a grid plane, the
    /// elements it has pieces in, sorted by key.
    RawVector<KeyValue> sorted_pieces() const {
        const BeginsTriangle begins{fragments_};
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

    /// Of a triangle with the fragments from first to last.
    void add_pieces_in_planes(std::int64_t first, std::int64_t last,
                              std::vector<KeyValue>& out) const {
        const std::int32_t triangle = fragments_[first].triangle;
        const auto corners = mesh_.corners(triangle);
        const auto add_pieces = [&](std::int64_t key, std::uint8_t PlacedFragment::*parts, int i) {
            for (std::int64_t fragment = first; fragment < last; ++fragment) {
                if (((fragments_[fragment].*parts >> i) & 1) == 0) continue;
                out.push_back({static_cast<std::uint64_t>(key),
                               static_cast<std::uint64_t>(fragments_[fragment].element)});
            }
        };
        for (int i = 0; i < 3; ++i) {
            if (planes_at(corners[i]) == 0) continue;
            const std::int64_t vertex = topology_.triangles[triangle][i];
            add_pieces(topology_.edge_count + vertex, &PlacedFragment::corners, i);
            const std::int32_t edge = topology_.edges[triangle][i];
            if (edge == MeshTopology::kNoEdge || !share_plane(corners[i], corners[(i + 1) % 3])) {
                continue;
            }
            add_pieces(edge, &PlacedFragment::edges, i);
        }
    }

    const GridMesh& mesh_;
    const MeshTopology& topology_;
    const FinestElements& elements_;
    RawVector<PlacedFragment> fragments_;
};

}  // namespace

RawVector<Link> find_links(const GridMesh& mesh, const MeshTopology& topology,
                           const RawVector<FragmentEntry>& fragments,
                           const FinestElements& elements) {
    const LinkFinder finder(mesh, topology, fragments, elements);
    RawVector<Link> links = finder.through_triangles();
    const RawVector<Link> others = finder.through_edges_and_vertices();
    links.insert(links.end(), others.begin(), others.end());
    sort_and_remove_copies(links);
    return links;
}

}  // namespace tracked_mcf
