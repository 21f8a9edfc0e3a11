// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/research/benchmark/cotangent_pattern.h"

#include <algorithm>
#include <numeric>

namespace tracked_mcf::benchmark {

namespace {

using Numbers = std::vector<std::int32_t>;

/// The mesh's edges, sorted by their smaller vertex.
struct Edges {
    Numbers begin;   ///< for each vertex, and the end
    Numbers larger;  ///< the larger vertex, ascending for each smaller one
    Numbers uses;    ///< number of triangles with this edge
    Numbers entry;   ///< index of its matrix entry

    std::int32_t find(std::int32_t a, std::int32_t b) const {
        const std::int32_t row = std::min(a, b);
        return static_cast<std::int32_t>(std::find(larger.begin() + begin[row],
                                                   larger.begin() + begin[row + 1],
                                                   std::max(a, b)) -
                                         larger.begin());
    }
};

Numbers inverse(const Numbers& order) {
    Numbers number(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) number[order[i]] = static_cast<int>(i);
    return number;
}

/// Returns the edges of each triangle. An edge of two triangles occurs twice.
Edges edges_with_copies(const std::vector<Triangle>& triangles, std::size_t vertex_count) {
    Edges edges;
    edges.begin.assign(vertex_count + 1, 0);
    const auto for_each = [&](const auto& body) {
        for (const Triangle& t : triangles) {
            for (int i = 0; i < 3; ++i) {
                const auto [smaller, larger] = std::minmax(t[i], t[(i + 1) % 3]);
                if (smaller != larger) body(smaller, larger);
            }
        }
    };
    for_each([&](std::int32_t smaller, std::int32_t) { ++edges.begin[smaller + 1]; });
    std::partial_sum(edges.begin.begin(), edges.begin.end(), edges.begin.begin());
    edges.larger.resize(edges.begin.back());
    Numbers next(edges.begin.begin(), edges.begin.end() - 1);
    for_each(
        [&](std::int32_t smaller, std::int32_t larger) { edges.larger[next[smaller]++] = larger; });
    return edges;
}

Edges edges_of(const std::vector<Triangle>& triangles, std::size_t vertex_count) {
    Edges edges = edges_with_copies(triangles, vertex_count);
    std::int32_t count = 0;
    for (std::size_t vertex = 0; vertex < vertex_count; ++vertex) {
        const std::int32_t begin = edges.begin[vertex];
        const std::int32_t end = edges.begin[vertex + 1];
        std::sort(edges.larger.begin() + begin, edges.larger.begin() + end);
        edges.begin[vertex] = count;
        for (std::int32_t k = begin; k < end; ++k) {
            if (count > edges.begin[vertex] && edges.larger[count - 1] == edges.larger[k]) {
                ++edges.uses.back();
                continue;
            }
            edges.larger[count++] = edges.larger[k];
            edges.uses.push_back(1);
        }
    }
    edges.begin[vertex_count] = count;
    edges.larger.resize(count);
    return edges;
}

std::vector<Triangle> renumbered(const TriangleMesh& mesh, const Numbers& number) {
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
        triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
    }
    return triangles;
}

/// Moves the vertices of the boundary behind all others. Returns the number of the others.
std::int32_t put_boundary_last(const Edges& edges, Numbers& order) {
    std::vector<std::uint8_t> constrained(order.size());
    for (std::size_t vertex = 0; vertex < order.size(); ++vertex) {
        for (std::int32_t k = edges.begin[vertex]; k < edges.begin[vertex + 1]; ++k) {
            if (edges.uses[k] == 1) constrained[vertex] = constrained[edges.larger[k]] = 1;
        }
    }
    const Numbers number = inverse(order);
    const auto first_constrained = std::stable_partition(
        order.begin(), order.end(),
        [&](std::int32_t vertex) { return constrained[number[vertex]] == 0; });
    return static_cast<std::int32_t>(first_constrained - order.begin());
}

void cut_into_blocks(int block_count, CotangentPattern& pattern) {
    for (std::int64_t block = 0; block <= block_count; ++block) {
        pattern.block_begin.push_back(
            static_cast<std::int32_t>(block * pattern.unknown_count / block_count));
    }
}

std::int32_t block_of(const CotangentPattern& pattern, std::int32_t row) {
    return static_cast<std::int32_t>(
        std::upper_bound(pattern.block_begin.begin(), pattern.block_begin.end() - 1, row) -
        pattern.block_begin.begin() - 1);
}

/// Assigns a matrix entry to each edge.
void number_entries(Edges& edges, CotangentPattern& pattern) {
    edges.entry.assign(edges.larger.size(), CotangentPattern::kNone);
    Numbers couplings;
    Numbers constrained;
    pattern.upper_column.reserve(edges.larger.size());
    pattern.upper_begin.push_back(0);
    for (std::int32_t row = 0; row < pattern.unknown_count; ++row) {
        const std::int32_t block_end = pattern.block_begin[block_of(pattern, row) + 1];
        for (std::int32_t k = edges.begin[row]; k < edges.begin[row + 1]; ++k) {
            const std::int32_t column = edges.larger[k];
            if (column < block_end) {
                edges.entry[k] = static_cast<std::int32_t>(pattern.upper_column.size());
                pattern.upper_column.push_back(column);
            } else if (column < pattern.unknown_count) {
                couplings.push_back(k);
                pattern.couplings.push_back({row, column});
            } else {
                constrained.push_back(k);
                pattern.constrained_edge_rows.push_back(row);
            }
        }
        pattern.upper_begin.push_back(static_cast<std::int32_t>(pattern.upper_column.size()));
    }
    std::int32_t next = pattern.first_coupling();
    for (const std::int32_t k : couplings) edges.entry[k] = next++;
    for (const std::int32_t k : constrained) edges.entry[k] = next++;
}

void transpose(CotangentPattern& pattern) {
    const std::int32_t n = pattern.unknown_count;
    pattern.lower_begin.assign(n + 1, 0);
    for (const std::int32_t column : pattern.upper_column) ++pattern.lower_begin[column + 1];
    std::partial_sum(pattern.lower_begin.begin(), pattern.lower_begin.end(),
                     pattern.lower_begin.begin());
    pattern.lower_column.resize(pattern.upper_column.size());
    pattern.lower_index.resize(pattern.upper_column.size());
    Numbers next(pattern.lower_begin.begin(), pattern.lower_begin.end() - 1);
    for (std::int32_t row = 0; row < n; ++row) {
        for (std::int32_t k = pattern.upper_begin[row]; k < pattern.upper_begin[row + 1]; ++k) {
            const std::int32_t index = next[pattern.upper_column[k]]++;
            pattern.lower_column[index] = row;
            pattern.lower_index[k] = index;
        }
    }
}

void find_fill(CotangentPattern& pattern) {
    const auto find = [&](std::int32_t row, std::int32_t column) {
        const auto end = pattern.upper_column.begin() + pattern.upper_begin[row + 1];
        const auto found =
            std::find(pattern.upper_column.begin() + pattern.upper_begin[row], end, column);
        return found == end ? CotangentPattern::kNone
                            : static_cast<std::int32_t>(found - pattern.upper_column.begin());
    };
    pattern.fill.reserve(pattern.upper_column.size());
    for (std::int32_t row = 0; row < pattern.unknown_count; ++row) {
        pattern.fill_begin.push_back(static_cast<std::int32_t>(pattern.fill.size()));
        for (std::int32_t a = pattern.upper_begin[row]; a < pattern.upper_begin[row + 1]; ++a) {
            for (std::int32_t b = a + 1; b < pattern.upper_begin[row + 1]; ++b) {
                pattern.fill.push_back(find(pattern.upper_column[a], pattern.upper_column[b]));
            }
        }
    }
}

/// Returns the block that contains the triangle, or the number of blocks if none does.
std::size_t owner_of(const CotangentPattern& pattern, const Triangle& t) {
    const std::size_t shared = pattern.block_begin.size() - 1;
    const auto [first, last] = std::minmax({t[0], t[1], t[2]});
    if (last >= pattern.unknown_count) return shared;
    const std::int32_t block = block_of(pattern, first);
    return last < pattern.block_begin[block + 1] ? static_cast<std::size_t>(block) : shared;
}

/// Sorts the triangles by block and by their smallest vertex.
void sort_triangles(const std::vector<Triangle>& triangles, const Edges& edges,
                    CotangentPattern& pattern) {
    const auto bucket_of = [&](const Triangle& t) {
        const std::size_t owner = owner_of(pattern, t);
        const bool shared = owner + 1 == pattern.block_begin.size();
        return shared ? pattern.vertex_count : std::min({t[0], t[1], t[2]});
    };
    std::vector<std::int64_t> next(pattern.vertex_count + 2, 0);
    for (const Triangle& t : triangles) ++next[bucket_of(t) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (const std::int32_t row : pattern.block_begin) pattern.triangle_begin.push_back(next[row]);
    pattern.triangle_begin.push_back(static_cast<std::int64_t>(triangles.size()));
    pattern.triangles.resize(triangles.size());
    const std::int32_t unread = pattern.entry_count() - 1;
    for (const Triangle& t : triangles) {
        TriangleIndices& indices = pattern.triangles[next[bucket_of(t)]++];
        for (int i = 0; i < 3; ++i) {
            const std::int32_t a = t[(i + 1) % 3];
            const std::int32_t b = t[(i + 2) % 3];
            const bool read = a != b && std::min(a, b) < pattern.unknown_count;
            indices.vertices[i] = t[i];
            indices.entries[i] = read ? edges.entry[edges.find(a, b)] : unread;
        }
    }
}

}  // namespace

CotangentPattern cotangent_pattern(const TriangleMesh& mesh, VertexOrder order, int block_count,
                                   bool lock_boundary) {
    CotangentPattern pattern;
    Numbers vertices = ordered_vertices(mesh, order);
    pattern.number = inverse(vertices);
    pattern.vertex_count = pattern.unknown_count = static_cast<std::int32_t>(vertices.size());
    std::vector<Triangle> triangles = renumbered(mesh, pattern.number);
    Edges edges = edges_of(triangles, vertices.size());
    if (lock_boundary) pattern.unknown_count = put_boundary_last(edges, vertices);
    if (pattern.unknown_count < pattern.vertex_count) {
        pattern.number = inverse(vertices);
        triangles = renumbered(mesh, pattern.number);
        edges = edges_of(triangles, vertices.size());
    }
    cut_into_blocks(block_count, pattern);
    number_entries(edges, pattern);
    transpose(pattern);
    find_fill(pattern);
    sort_triangles(triangles, edges, pattern);
    return pattern;
}

}  // namespace tracked_mcf::benchmark
