#include "filter_tracked_mcf/core/mesh_topology.h"

#include <algorithm>
#include <limits>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/sorting.h"

namespace tracked_mcf {

namespace {

/// The sides of all triangles that join two different vertices, in the order of these: the key is
/// made of the vertices, the value 3 * triangle + side.
std::vector<KeyValue> sorted_sides(const MeshTopology& topology) {
    const auto triangle_count = static_cast<std::int64_t>(topology.triangles.size());
    const std::uint64_t vertex_count = topology.welded.size();
    auto sides = parallel_collect<KeyValue>(
        triangle_count, [&](std::int64_t begin, std::int64_t end, std::vector<KeyValue>& out) {
            for (std::int64_t triangle = begin; triangle < end; ++triangle) {
                const Triangle& t = topology.triangles[triangle];
                for (int side = 0; side < 3; ++side) {
                    const auto [a, b] = std::minmax({t[side], t[(side + 1) % 3]});
                    if (a == b) continue;
                    out.push_back({static_cast<std::uint64_t>(a) * vertex_count +
                                       static_cast<std::uint64_t>(b),
                                   static_cast<std::uint64_t>(3 * triangle + side)});
                }
            }
        });
    sort_by_key(sides);
    return sides;
}

void number_edges(MeshTopology& topology) {
    constexpr std::int32_t most = std::numeric_limits<std::int32_t>::max();
    topology.edges.assign(topology.triangles.size(),
                          {MeshTopology::kNoEdge, MeshTopology::kNoEdge, MeshTopology::kNoEdge});
    const std::vector<KeyValue> sides = sorted_sides(topology);
    serial_for(static_cast<std::int64_t>(sides.size()), [&](std::int64_t i) {
        if (i == 0 || sides[i].key != sides[i - 1].key) {
            if (topology.edge_count == most) {
                throw InvalidMesh("The mesh has more than 2147483647 edges; simplify it first.");
            }
            ++topology.edge_count;
        }
        topology.edges[sides[i].value / 3][sides[i].value % 3] = topology.edge_count - 1;
    });
}

bool has_equal_vertices(const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
}

}  // namespace

MeshTopology topology_of(const TriangleMesh& mesh) {
    MeshTopology topology;
    topology.welded = weld_coincident_vertices(mesh);
    topology.triangles.reserve(mesh.triangles.size());
    for_each_item(mesh.triangles, [&](const Triangle& t) {
        const std::vector<std::int32_t>& welded = topology.welded;
        topology.triangles.push_back({welded[t[0]], welded[t[1]], welded[t[2]]});
    });
    number_edges(topology);
    return topology;
}

std::vector<std::uint8_t> boundary_edges(const MeshTopology& topology) {
    // Of every edge the third vertex of its triangles, as long as they agree on it.
    constexpr std::int32_t none_yet = -1;
    constexpr std::int32_t several = -2;
    std::vector<std::int32_t> opposite(static_cast<std::size_t>(topology.edge_count), none_yet);
    const auto triangle_count = static_cast<std::int64_t>(topology.triangles.size());
    serial_for(triangle_count, [&](std::int64_t triangle) {
        const Triangle& t = topology.triangles[triangle];
        if (has_equal_vertices(t)) return;
        for (int side = 0; side < 3; ++side) {
            std::int32_t& third = opposite[topology.edges[triangle][side]];
            const std::int32_t here = t[(side + 2) % 3];
            third = third == none_yet || third == here ? here : several;
        }
    });
    std::vector<std::uint8_t> boundary(topology.triangles.size(), 0);
    serial_for(triangle_count, [&](std::int64_t triangle) {
        if (has_equal_vertices(topology.triangles[triangle])) return;
        for (int side = 0; side < 3; ++side) {
            if (opposite[topology.edges[triangle][side]] == several) continue;
            boundary[triangle] |= static_cast<std::uint8_t>(1 << side);
        }
    });
    return boundary;
}

bool is_oriented_consistently(const MeshTopology& topology) {
    std::vector<std::int32_t> balance(static_cast<std::size_t>(topology.edge_count), 0);
    serial_for(static_cast<std::int64_t>(topology.triangles.size()), [&](std::int64_t triangle) {
        const Triangle& t = topology.triangles[triangle];
        for (int side = 0; side < 3; ++side) {
            const std::int32_t edge = topology.edges[triangle][side];
            if (edge != MeshTopology::kNoEdge)
                balance[edge] += t[side] < t[(side + 1) % 3] ? 1 : -1;
        }
    });
    return std::all_of(balance.begin(), balance.end(), [](auto sum) { return sum == 0; });
}

}  // namespace tracked_mcf
