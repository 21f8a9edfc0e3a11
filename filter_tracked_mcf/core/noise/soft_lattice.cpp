// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/soft_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/noise/comb.h"

namespace tracked_mcf {

namespace {

/// So many vertices and triangles are as marching cubes make them.
constexpr double kOfMarchingCubes = 0.95;

/// Cells are looked for on the second number of vertices, several for each plane of the largest
/// images, if the first number of them has equal coordinates.
constexpr std::int32_t kFewVertices = 1000, kManyVertices = 20000;

/// A coordinate is whole up to this, in cells.
constexpr double kSoftWhole = 0.01;

/// The histogram of fractions. A label has at most so many of them, counted by their entropy: 2 to
/// 12 if it was averaged over two cells or blurred by up to 0.6 cells, and 16 if by 0.8. Smooth
/// fields have 15 to 20. Fewer vertices show nothing.
constexpr std::size_t kFractions = 20;
constexpr double kMostFractions = 12;
constexpr std::int64_t kLeastBetween = 400;

/// Where a vertex is on a lattice.
struct Between {
    static constexpr std::int8_t kCorner = 3, kOff = 4;

    std::int8_t axis = kOff;  ///< along which it is between two corners, or one of the above
    std::int32_t level = 0;   ///< the number of the corner below
    double fraction = 0;      ///< how far it is from there
};

/// Returns a position in cells of a lattice along the axes.
Eigen::Vector3d in_cells(const Lattice& lattice, const Eigen::Vector3d& position) {
    return (position - lattice.origin).cwiseQuotient(lattice.cell.diagonal());
}

Between between(const Eigen::Vector3d& at) {
    Between result;
    result.axis = Between::kCorner;
    for (int axis = 0; axis < 3; ++axis) {
        if (from_whole(at[axis]) < kSoftWhole) continue;
        if (result.axis != Between::kCorner) return {};
        const double below = std::floor(at[axis]);
        result = {static_cast<std::int8_t>(axis), static_cast<std::int32_t>(below),
                  at[axis] - below};
    }
    return result;
}

/// Returns whether one cube has all corners of a triangle.
bool is_in_cube(const std::array<Eigen::Vector3d, 3>& corners) {
    const Eigen::Array3d least = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]).array();
    const Eigen::Array3d most = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]).array();
    return ((most - (least + kSoftWhole).floor()) < 1 + kSoftWhole).all();
}

std::vector<double> coordinates(const std::vector<Eigen::Vector3d>& positions, int axis) {
    std::vector<double> values(positions.size());
    std::transform(positions.begin(), positions.end(), values.begin(),
                   [axis](const Eigen::Vector3d& position) { return position[axis]; });
    return values;
}

/// Returns the widest cells at whose corners most vertices have two coordinates, or none.
std::optional<Lattice> cells_of(const NoisySurface& surface, const PartRange& part) {
    // Most surfaces have no equal coordinates.
    const std::vector<Eigen::Vector3d> few = some_positions(surface, part, kFewVertices);
    for (int axis = 0; axis < 3; ++axis) {
        if (!has_equal_values(coordinates(few, axis))) return {};
    }
    const std::vector<Eigen::Vector3d> positions = some_positions(surface, part, kManyVertices);
    std::array<std::vector<Comb>, 3> combs;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        combs[axis] = combs_of_commonest(coordinates(positions, static_cast<int>(axis)));
        if (combs[axis].empty()) return {};
    }
    std::optional<Lattice> widest;
    for (const Comb& x : combs[0]) {
        for (const Comb& y : combs[1]) {
            for (const Comb& z : combs[2]) {
                Lattice lattice;
                lattice.cell = Eigen::Vector3d(x.distance, y.distance, z.distance).asDiagonal();
                lattice.origin << x.first, y.first, z.first;
                lattice.is_marching = lattice.is_soft = true;
                if (widest && lattice.cell.determinant() <= widest->cell.determinant()) continue;
                const auto on =
                    std::count_if(few.begin(), few.end(), [&](const Eigen::Vector3d& position) {
                        return between(in_cells(lattice, position)).axis != Between::kOff;
                    });
                if (static_cast<double>(on) >= kOfMarchingCubes * static_cast<double>(few.size()))
                    widest = lattice;
            }
        }
    }
    return widest;
}

/// Returns whether vertices are at few fractions of the way between two corners. Only those count
/// that are near others between other corners: flat sides are anywhere.
bool has_few_fractions(const NoisySurface& surface, const PartRange& part, const Lattice& lattice) {
    const Stars& stars = surface.stars;
    std::vector<Between> places(static_cast<std::size_t>(part.vertex_count()));
    const auto place_of = [&](std::int32_t vertex) -> Between& {
        return places[vertex - part.first_vertex];
    };
    parallel_for_rows(part.vertex_count(), [&](std::int32_t i) {
        places[i] = between(in_cells(lattice, surface.positions[part.first_vertex + i]));
    });
    std::vector<std::uint8_t> counts(places.size());
    parallel_for_rows(part.vertex_count(), [&](std::int32_t i) {
        const Between& place = places[i];
        if (place.axis >= Between::kCorner) return;
        for_each_neighbour(stars, part.first_vertex + i, [&](std::int32_t neighbour) {
            for_each_neighbour(stars, neighbour, [&](std::int32_t other) {
                const Between& there = place_of(other);
                if (there.axis == place.axis && there.level != place.level) counts[i] = 1;
            });
        });
    });
    std::array<double, kFractions> histogram = {};
    double count = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (counts[i] == 0) continue;
        const auto bin = static_cast<std::size_t>(kFractions * places[i].fraction);
        ++histogram[std::min(bin, kFractions - 1)];
        ++count;
    }
    if (count < kLeastBetween) return false;
    double entropy = 0;
    for (const double times : histogram) {
        if (times > 0) entropy -= times / count * std::log(times / count);
    }
    return std::exp(entropy) <= kMostFractions;
}

}  // namespace

std::optional<Lattice> soft_lattice_of(const NoisySurface& surface, const PartRange& part) {
    const std::optional<Lattice> lattice = cells_of(surface, part);
    if (!lattice || !is_soft_border(surface, part, *lattice)) return {};
    return has_few_fractions(surface, part, *lattice) ? lattice : std::nullopt;
}

bool is_soft_border(const NoisySurface& surface, const PartRange& part, const Lattice& lattice) {
    const std::int64_t vertices = parallel_count(part.vertex_count(), [&](std::int64_t i) {
        const Eigen::Vector3d& position = surface.positions[part.first_vertex + i];
        return between(in_cells(lattice, position)).axis != Between::kOff;
    });
    if (static_cast<double>(vertices) < kOfMarchingCubes * part.vertex_count()) return false;
    const std::int64_t count = part.end_triangle - part.first_triangle;
    const std::int64_t triangles = parallel_count(count, [&](std::int64_t i) {
        auto corners =
            corners_of(surface.positions, surface.stars.triangles[part.first_triangle + i]);
        for (Eigen::Vector3d& corner : corners) corner = in_cells(lattice, corner);
        return is_in_cube(corners);
    });
    return static_cast<double>(triangles) >= kOfMarchingCubes * static_cast<double>(count);
}

}  // namespace tracked_mcf
