// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/weld.h"

#include <algorithm>
#include <cstring>

#include "filter_tracked_mcf/core/parallel/marks.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/sorting.h"

namespace tracked_mcf {

namespace {

/// Returns a hash of a position. Equal positions have equal hashes; different positions hardly ever
/// do.
std::uint64_t hash_of(const Eigen::Vector3d& position) {
    std::uint64_t hash = 0;
    for (const double coordinate : position) {
        const double without_negative_zero = coordinate + 0.0;
        std::uint64_t bits = 0;
        std::memcpy(&bits, &without_negative_zero, sizeof(bits));
        hash = (hash ^ bits) * 0x9E3779B97F4A7C15;  // 2^64 over the golden ratio
        hash ^= hash >> 32U;
    }
    return hash;
}

/// A vertex and the highest bits of its position's hash.
struct HashedVertex {
    std::uint32_t hash;
    std::int32_t vertex;
};

/// Returns the referenced vertices sorted by hash, then by index. The hashes are short, to be
/// sorted quickly, but long enough that few positions share one.
RawVector<HashedVertex> vertices_by_hash(const TriangleMesh& mesh,
                                         const std::vector<std::uint8_t>& referenced) {
    unsigned bits = 8;
    while (bits < 30 && (std::size_t{1} << (bits - 2)) < mesh.positions.size()) ++bits;
    auto vertices = parallel_collect_if<HashedVertex, RawVector<HashedVertex>>(
        static_cast<std::int64_t>(mesh.positions.size()),
        [&](std::int64_t vertex) { return referenced[vertex] != 0; },
        [&](std::int64_t vertex) {
            const std::uint64_t hash = hash_of(mesh.positions[vertex]) >> (64 - bits);
            return HashedVertex{static_cast<std::uint32_t>(hash),
                                static_cast<std::int32_t>(vertex)};
        });
    sort_by(vertices, [](const HashedVertex& entry) { return std::uint64_t{entry.hash}; });
    return vertices;
}

/// Welds the vertices in [first, last), which have the same hash. `different` is workspace: the
/// vertices so far that have different positions.
void weld(const TriangleMesh& mesh, const HashedVertex* first, const HashedVertex* last,
          std::vector<std::int32_t>& different, std::vector<std::int32_t>& welded) {
    different.clear();
    for (; first != last; ++first) {
        const std::int32_t vertex = first->vertex;
        const auto same = std::find_if(different.begin(), different.end(), [&](std::int32_t other) {
            return mesh.positions[other] == mesh.positions[vertex];
        });
        if (same == different.end()) {
            different.push_back(vertex);
        } else {
            welded[vertex] = *same;
        }
    }
}

}  // namespace

std::vector<std::uint8_t> referenced_vertices(const TriangleMesh& mesh) {
    Marks referenced(static_cast<std::int64_t>(mesh.positions.size()));
    parallel_for_items(mesh.triangles, [&](const Triangle& triangle) {
        for (const std::int32_t vertex : triangle) referenced.set(vertex);
    });
    return referenced.flags();
}

std::vector<std::int32_t> weld_coincident_vertices(const TriangleMesh& mesh,
                                                   const std::vector<std::uint8_t>& referenced) {
    std::vector<std::int32_t> welded(mesh.positions.size());
    parallel_for_rows(static_cast<std::int64_t>(welded.size()),
                      [&](std::int32_t vertex) { welded[vertex] = vertex; });
    const RawVector<HashedVertex> vertices = vertices_by_hash(mesh, referenced);
    const auto begins = runs_by(vertices, [](const HashedVertex& entry) { return entry.hash; });
    parallel_for_runs(
        static_cast<std::int64_t>(vertices.size()), begins,
        [&](std::int64_t begin, std::int64_t end) {
            std::vector<std::int32_t> different;
            for_each_run(begin, end, begins, [&](std::int64_t first, std::int64_t last) {
                weld(mesh, vertices.data() + first, vertices.data() + last, different, welded);
            });
        });
    return welded;
}

}  // namespace tracked_mcf
