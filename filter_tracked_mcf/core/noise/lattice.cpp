// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/lattice.h"

#include <Eigen/LU>
#include <algorithm>
#include <bitset>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/noise/comb.h"
#include "filter_tracked_mcf/core/noise/relief.h"
#include "filter_tracked_mcf/core/noise/soft_lattice.h"

namespace tracked_mcf {

namespace {

/// So many vertices, triangles and edges of a border are as the lattice has them. Some tables of
/// marching cubes put a vertex into the middle of a cell.
constexpr double kNearlyAll = 0.95;
constexpr std::int32_t kLeastVerticesOfLattice = 24;
/// Marching cubes have this share of their halves along a second side, at least; rasters along one
/// side alone.
constexpr double kLeastHalves = 0.02;

/// Lattices are tried on so many vertices. Their sides are among so many of the commonest edges of
/// so many triangles, which are the same up to this, in edges.
constexpr std::int32_t kTriedVertices = 1000;
constexpr std::size_t kTriedSides = 24, kCommonEdges = 200;
constexpr std::int64_t kTriedTriangles = 20000;
constexpr double kSameEdge = 0.02;

/// Edges are parallel if the sine of their angle is less. Sides have this determinant at least,
/// once they are unit vectors: scanners tilt by up to 30°.
constexpr double kParallel = 0.05, kLeastDeterminant = 0.8;

/// What vertex_kind() returns besides the side along which a coordinate is a half.
constexpr int kAllWhole = 3, kOther = 4;

/// Returns the side along which alone a coordinate in cells is a half, while the others are whole.
int vertex_kind(const Eigen::Vector3d& at) {
    int kind = kAllWhole;
    for (int side = 0; side < 3; ++side) {
        if (from_whole(at[side]) < kWhole) continue;
        if (kind != kAllWhole || from_whole(at[side] + 0.5) >= kWhole) return kOther;
        kind = side;
    }
    return kind;
}

/// Returns the lattice of faces whose sides have these directions, on the combs of coordinates.
Lattice lattice_on(const Eigen::Matrix3d& directions, const std::array<Comb, 3>& combs) {
    Lattice lattice;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto column = static_cast<Eigen::Index>(axis);
        lattice.cell.col(column) = combs[axis].distance * directions.col(column);
        lattice.origin += combs[axis].first * directions.col(column);
    }
    return lattice;
}

/// Returns the lattice of marching cubes if `halves` has all their vertices on whole coordinates.
/// The parity of these tells which are halves: exactly one is odd. Along a side on which a label
/// ends at the border of the image, there may be no halves.
Lattice marching_on(const std::vector<Eigen::Vector3d>& positions, const Lattice& halves) {
    std::array<std::int64_t, 8> counts = {};
    const Eigen::Matrix3d inverse = halves.cell.inverse();
    for (const Eigen::Vector3d& position : positions) {
        const Eigen::Vector3d at = inverse * (position - halves.origin);
        std::size_t parity = 0;
        for (int axis = 0; axis < 3; ++axis)
            parity |= std::size_t{std::lround(at[axis]) % 2 != 0} << axis;
        ++counts[parity];
    }
    std::int64_t most = -1;
    std::size_t sides = 0, odd = 0;
    for (std::size_t halved = 1; halved < 8; ++halved) {
        for (std::size_t offset = 0; offset < 8; ++offset) {
            if ((offset & ~halved) != 0) continue;
            std::int64_t count = 0;
            for (std::size_t parity = 0; parity < 8; ++parity) {
                if (std::bitset<3>((parity ^ offset) & halved).count() == 1)
                    count += counts[parity];
            }
            if (count <= most) continue;
            most = count;
            sides = halved;
            odd = offset;
        }
    }
    Lattice lattice = halves;
    lattice.is_marching = true;
    for (int axis = 0; axis < 3; ++axis) {
        if ((odd >> axis & 1U) != 0) lattice.origin += halves.cell.col(axis);
        if ((sides >> axis & 1U) != 0) lattice.cell.col(axis) *= 2;
    }
    return lattice;
}

/// Returns the lattice with sides along these directions whose cells a part is the border of. The
/// given positions are those of the part, or of some of its vertices.
std::optional<Lattice> lattice_along(const NoisySurface& surface, const PartRange& part,
                                     const std::vector<Eigen::Vector3d>& positions,
                                     const Eigen::Matrix3d& directions) {
    const Eigen::Matrix3d inverse = directions.inverse();
    std::array<Comb, 3> combs;
    std::vector<double> values(positions.size());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::transform(positions.begin(), positions.end(), values.begin(),
                       [row = inverse.row(static_cast<Eigen::Index>(axis))](
                           const Eigen::Vector3d& position) { return row.dot(position); });
        combs[axis] = comb_of(values);
        if (combs[axis].distance == 0) return {};
    }
    Lattice faces = lattice_on(directions, combs);
    if (is_border(surface, part, faces)) return faces;
    Lattice marching = marching_on(positions, faces);
    if (is_border(surface, part, marching)) return marching;
    return {};
}

/// Returns the edges of a part that are there most often, the commonest first, or none if they are
/// not most of all edges. An edge and its opposite are the same.
std::vector<Eigen::Vector3d> common_edges(const NoisySurface& surface, const PartRange& part) {
    struct Bin {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        double count = 0;
    };
    std::map<std::array<std::int64_t, 3>, Bin> bins;
    std::size_t triangles = 0;
    const std::int64_t step = (part.end_triangle - part.first_triangle) / kTriedTriangles + 1;
    for (std::int64_t i = part.first_triangle; i < part.end_triangle; i += step) {
        const auto corners = corners_of(surface.positions, surface.stars.triangles[i]);
        ++triangles;
        for (std::size_t k = 0; k < 3; ++k) {
            Eigen::Vector3d edge = corners[(k + 1) % 3] - corners[k];
            std::array<std::int64_t, 3> key = {}, opposite = {};
            for (std::size_t axis = 0; axis < 3; ++axis) {
                key[axis] = std::lround(edge[static_cast<Eigen::Index>(axis)] / kSameEdge);
                opposite[axis] = -key[axis];
            }
            if (opposite > key) edge = -edge;
            Bin& bin = bins[std::max(key, opposite)];
            bin.sum += edge;
            ++bin.count;
        }
        // Most surfaces have too many different edges.
        if (bins.size() > triangles / 3 + kCommonEdges) return {};
    }
    std::vector<Bin> sorted(bins.size());
    std::transform(bins.begin(), bins.end(), sorted.begin(),
                   [](const auto& bin) { return bin.second; });
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const Bin& a, const Bin& b) { return a.count > b.count; });
    sorted.resize(std::min(sorted.size(), kCommonEdges));
    std::vector<Eigen::Vector3d> edges(sorted.size());
    std::transform(sorted.begin(), sorted.end(), edges.begin(),
                   [](const Bin& bin) -> Eigen::Vector3d { return bin.sum / bin.count; });
    return edges;
}

/// Orders three directions so that each is along its own axis as well as possible.
Eigen::Matrix3d in_order_of_axes(Eigen::Matrix3d directions) {
    for (Eigen::Index axis = 0; axis < 2; ++axis) {
        Eigen::Index best = 0;
        directions.row(axis).tail(3 - axis).cwiseAbs().maxCoeff(&best);
        directions.col(axis).swap(directions.col(axis + best));
    }
    return directions;
}

/// Edges that may be sides of cells.
class SideCandidates {
public:
    explicit SideCandidates(std::vector<Eigen::Vector3d> edges) : edges_(std::move(edges)) {
        for (const Eigen::Vector3d& edge : edges_) {
            const auto is_parallel = [&](const Eigen::Vector3d& other) {
                return edge.cross(other).norm() < kParallel * edge.norm() * other.norm();
            };
            if (sides_.size() < kTriedSides &&
                std::none_of(sides_.begin(), sides_.end(), is_parallel))
                sides_.push_back(edge);
        }
    }

    /// Calls try_directions(directions) for three sides each, until it returns true.
    template <class Try>
    void find(const Try& try_directions) const {
        for (std::size_t a = 0; a < sides_.size(); ++a) {
            for (std::size_t b = 0; b < a; ++b) {
                for (std::size_t c = 0; c < b; ++c) {
                    Eigen::Matrix3d cell;
                    cell << sides_[c], sides_[b], sides_[a];
                    const Eigen::Matrix3d directions = cell.colwise().normalized();
                    if (std::abs(directions.determinant()) < kLeastDeterminant) continue;
                    if (!has_edges(cell)) continue;
                    if (try_directions(in_order_of_axes(directions))) return;
                }
            }
        }
    }

private:
    /// Returns whether nearly all edges are those of a border: none, a half or all of each side.
    bool has_edges(const Eigen::Matrix3d& cell) const {
        const Eigen::Matrix3d inverse = cell.inverse();
        const auto count = std::count_if(edges_.begin(), edges_.end(), [&](const auto& edge) {
            const Eigen::Vector3d halves = 2 * (inverse * edge);
            return halves.cwiseAbs().maxCoeff() < 2 + kWhole &&
                   std::all_of(halves.begin(), halves.end(),
                               [](double coordinate) { return from_whole(coordinate) < kWhole; });
        });
        return static_cast<double>(count) >= kNearlyAll * static_cast<double>(edges_.size());
    }

    std::vector<Eigen::Vector3d> edges_, sides_;
};

}  // namespace

std::size_t side_of(const std::array<Eigen::Vector3d, 3>& corners) {
    constexpr double parallel = 0.999;
    const Eigen::Vector3d normal = twice_vector_area(corners[0], corners[1], corners[2]);
    Eigen::Index side = 0;
    return normal.cwiseAbs().maxCoeff(&side) > parallel * normal.norm()
               ? static_cast<std::size_t>(side)
               : 3;
}

bool is_border(const NoisySurface& surface, const PartRange& part, const Lattice& lattice) {
    if (lattice.is_soft) return is_soft_border(surface, part, lattice);
    const Eigen::Matrix3d inverse = lattice.cell.inverse();
    const auto kind_of_vertex = [&](std::int64_t vertex) {
        return vertex_kind(inverse * (surface.positions[vertex] - lattice.origin));
    };
    const auto is_of_cell = [&](std::int64_t triangle) {
        constexpr double longest = 1.1;  // of an edge, in cells
        auto corners = corners_of(surface.positions, surface.stars.triangles[triangle]);
        for (Eigen::Vector3d& corner : corners) corner = inverse * (corner - lattice.origin);
        for (std::size_t k = 0; k < 3; ++k) {
            const Eigen::Vector3d edge = corners[(k + 1) % 3] - corners[k];
            if (edge.lpNorm<Eigen::Infinity>() > longest) return false;
        }
        return lattice.is_marching || side_of(corners) < 3;
    };
    const std::int64_t vertices = part.end_vertex - part.first_vertex;
    const auto share_of = [&](int kind) {
        return static_cast<double>(parallel_count(
                   vertices,
                   [&](std::int64_t i) { return kind_of_vertex(part.first_vertex + i) == kind; })) /
               static_cast<double>(vertices);
    };
    if (lattice.is_marching) {
        std::array<double, 3> halves = {share_of(0), share_of(1), share_of(2)};
        std::sort(halves.begin(), halves.end());
        if (halves[0] + halves[1] + halves[2] < kNearlyAll || halves[1] < kLeastHalves)
            return false;
    } else if (share_of(kAllWhole) < kNearlyAll) {
        return false;
    }
    const std::int64_t triangles = part.end_triangle - part.first_triangle;
    const std::int64_t of_cells = parallel_count(
        triangles, [&](std::int64_t i) { return is_of_cell(part.first_triangle + i); });
    return static_cast<double>(of_cells) >= kNearlyAll * static_cast<double>(triangles);
}

std::optional<Lattice> lattice_of(const NoisySurface& surface, const PartRange& part) {
    const std::int32_t count = part.vertex_count();
    if (count < kLeastVerticesOfLattice) return {};
    const auto* const first = surface.positions.data() + part.first_vertex;
    const std::vector<Eigen::Vector3d> some = some_positions(surface, part, kTriedVertices);
    std::optional<Eigen::Matrix3d> directions;
    const auto try_directions = [&](const Eigen::Matrix3d& tried) {
        if (lattice_along(surface, part, some, tried)) directions = tried;
        return directions.has_value();
    };
    if (!try_directions(Eigen::Matrix3d::Identity())) {
        if (const auto soft = soft_lattice_of(surface, part)) return soft;
        SideCandidates(common_edges(surface, part)).find(try_directions);
        // Low reliefs in whole numbers are on sheared lattices by chance.
        if (!directions || relief_of(surface, part).is_relief) return {};
    }
    return lattice_along(surface, part, {first, first + count}, *directions);
}

}  // namespace tracked_mcf
