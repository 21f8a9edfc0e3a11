// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/cracks.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/mesh/measures.h"

namespace tracked_mcf {

namespace {

/// The largest distance of a pair that is joined, relative to the diagonal and to the shortest edge
/// at either vertex; and of a pair that is found, relative to that edge.
constexpr double kJoinedOfDiagonal = 1e-6, kJoinedOfEdge = 1e-4, kFoundOfEdge = 1e-2;
/// So many vertices are compared with one, at most: more in so small a place are no crack.
constexpr int kMostCompared = 64;

constexpr std::int32_t kNone = -1;

/// The vertices on the boundary, with numbers of their own.
struct Rims {
    std::vector<std::int32_t> numbers;                  ///< per vertex of the mesh, or kNone
    std::vector<std::int32_t> vertices;                 ///< of the mesh
    std::vector<std::vector<std::int32_t>> neighbours;  ///< along the boundary, per number
    std::vector<double> shortest;                       ///< edge of each, on the boundary or not
    double median = 0;                                  ///< edge of the boundary
};

Rims rims_of(const TriangleMesh& mesh, const MeshTopology& topology) {
    Rims rims;
    rims.numbers.assign(mesh.positions.size(), kNone);
    const auto number_of = [&](std::int32_t vertex) {
        std::int32_t& number = rims.numbers[vertex];
        if (number == kNone) {
            number = static_cast<std::int32_t>(rims.vertices.size());
            rims.vertices.push_back(vertex);
            rims.neighbours.emplace_back();
        }
        return number;
    };
    std::vector<double> lengths;
    for (std::size_t t = 0; t < topology.triangles.size(); ++t) {
        for (int side = 0; side < 3; ++side) {
            if (!has_bit(topology.boundary[t], side)) continue;
            const std::int32_t a = topology.triangles[t][side];
            const std::int32_t b = topology.triangles[t][(side + 1) % 3];
            const std::int32_t i = number_of(a), j = number_of(b);
            rims.neighbours[i].push_back(j);
            rims.neighbours[j].push_back(i);
            lengths.push_back((mesh.positions[a] - mesh.positions[b]).norm());
        }
    }
    if (lengths.empty()) return rims;
    rims.shortest.assign(rims.vertices.size(), std::numeric_limits<double>::infinity());
    for (const Triangle& t : topology.triangles) {
        for (int side = 0; side < 3; ++side) {
            const std::int32_t a = t[side], b = t[(side + 1) % 3];
            for (const std::int32_t number : {rims.numbers[a], rims.numbers[b]}) {
                if (number == kNone || a == b) continue;
                const double length = (mesh.positions[a] - mesh.positions[b]).norm();
                rims.shortest[number] = std::min(rims.shortest[number], length);
            }
        }
    }
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::nth_element(lengths.begin(), middle, lengths.end());
    rims.median = *middle;
    return rims;
}

/// Finds vertices of the boundary by their places, in cells of one width.
class Places {
public:
    Places(const TriangleMesh& mesh, const Rims& rims, double width)
        : mesh_(mesh), rims_(rims), width_(width) {
        for (std::size_t i = 0; i < rims.vertices.size(); ++i) {
            cells_[cell_of(position(i))].push_back(static_cast<std::int32_t>(i));
        }
    }

    /// Returns the nearest vertex within a cell's width that is not next to `number` along the
    /// boundary, or kNone, also if two are at the same distance.
    std::int32_t nearest(std::int32_t number) const {
        const Eigen::Vector3d& at = position(static_cast<std::size_t>(number));
        const auto& neighbours = rims_.neighbours[number];
        double least = width_ * width_;
        std::int32_t found = kNone;
        int compared = 0;
        for (int k = 0; k < 27; ++k) {
            const Eigen::Vector3i shift(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
            const auto cell = cells_.find(cell_of(at + width_ * shift.cast<double>()));
            if (cell == cells_.end()) continue;
            for (const std::int32_t other : cell->second) {
                if (other == number || std::count(neighbours.begin(), neighbours.end(), other) > 0)
                    continue;
                if (++compared > kMostCompared) return kNone;
                const double square =
                    (position(static_cast<std::size_t>(other)) - at).squaredNorm();
                if (square > least) continue;
                found = square < least ? other : kNone;
                least = square;
            }
        }
        return found;
    }

private:
    const Eigen::Vector3d& position(std::size_t number) const {
        return mesh_.positions[rims_.vertices[number]];
    }

    /// Two cells may have one key: then more vertices are compared.
    std::uint64_t cell_of(const Eigen::Vector3d& at) const {
        std::uint64_t key = 0;
        for (const double coordinate : at) {
            const auto cell = static_cast<std::int64_t>(std::floor(coordinate / width_));
            key = (key ^ static_cast<std::uint64_t>(cell)) * 0x9e3779b97f4a7c15U;
            key ^= key >> 32U;
        }
        return key;
    }

    const TriangleMesh& mesh_;
    const Rims& rims_;
    double width_;
    std::unordered_map<std::uint64_t, std::vector<std::int32_t>> cells_;
};

/// Leaves out pairs that a triangle joins: such a triangle is narrow, and no crack.
void leave_out_joined(const MeshTopology& topology, const Rims& rims,
                      std::vector<std::int32_t>& pairs) {
    for (const Triangle& t : topology.triangles) {
        for (int side = 0; side < 3; ++side) {
            const std::int32_t number = rims.numbers[t[side]];
            if (number == kNone || pairs[number] == kNone) continue;
            const std::int32_t other = pairs[number];
            if (rims.vertices[other] == t[(side + 1) % 3]) pairs[number] = pairs[other] = kNone;
        }
    }
}

/// Returns, per vertex of the boundary, the other one of its pair or kNone.
std::vector<std::int32_t> pairs_of(const TriangleMesh& mesh, const MeshTopology& topology,
                                   const Rims& rims, double width) {
    const Places places(mesh, rims, width);
    const auto count = static_cast<std::int32_t>(rims.vertices.size());
    std::vector<std::int32_t> nearest(rims.vertices.size()), pairs(rims.vertices.size(), kNone);
    parallel_for_rows(count, [&](std::int32_t i) { nearest[i] = places.nearest(i); });
    const auto are_mutual = [&](std::int32_t i, std::int32_t j) {
        return nearest[i] == j && nearest[j] == i;
    };
    for (std::int32_t i = 0; i < count; ++i) {
        const std::int32_t j = nearest[i];
        if (j == kNone || !are_mutual(i, j)) continue;
        for (const std::int32_t next : rims.neighbours[i]) {
            for (const std::int32_t other : rims.neighbours[j]) {
                if (next == other || are_mutual(next, other)) pairs[i] = j;
            }
        }
    }
    leave_out_joined(topology, rims, pairs);
    return pairs;
}

}  // namespace

CrackReport close_cracks(const TriangleMesh& mesh, MeshTopology& topology) {
    CrackReport report;
    const Rims rims = rims_of(mesh, topology);
    if (rims.vertices.empty()) return report;
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (topology.referenced[i] != 0) box.extend(mesh.positions[i]);
    }
    const double joined = kJoinedOfDiagonal * box.diagonal().norm();
    const double width = std::max(joined, kFoundOfEdge * rims.median);
    if (!(width > 0) || !std::isfinite(width)) return report;
    const std::vector<std::int32_t> pairs = pairs_of(mesh, topology, rims, width);

    std::vector<std::int32_t> representatives;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
        const std::int32_t j = pairs[i];
        if (j == kNone || rims.vertices[i] > rims.vertices[j]) continue;
        const std::int32_t a = rims.vertices[i], b = rims.vertices[j];
        const double distance = (mesh.positions[a] - mesh.positions[b]).norm();
        const double shortest = std::min(rims.shortest[i], rims.shortest[j]);
        if (distance <= std::min(joined, kJoinedOfEdge * shortest)) {
            representatives.resize(mesh.positions.size(), kNone);
            representatives[b] = a;
            ++report.joined_vertices;
        } else if (distance <= kFoundOfEdge * shortest) {
            ++report.open_pairs;
            report.open_width = std::max(report.open_width, distance);
        }
    }
    if (representatives.empty()) return report;
    const auto join = [&](std::int32_t& vertex) {
        if (representatives[vertex] != kNone) vertex = representatives[vertex];
    };
    for (std::int32_t& vertex : topology.welded) join(vertex);
    for (Triangle& t : topology.triangles) {
        for (std::int32_t& vertex : t) join(vertex);
    }
    find_edges(topology);
    return report;
}

}  // namespace tracked_mcf
