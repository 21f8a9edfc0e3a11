// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/flatness.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/pi.h"

namespace tracked_mcf {

namespace {

/// An edge is flat if it turns by less than this angle, and tells nothing if rounding alone turns
/// it by more than that.
constexpr double kFlatAngle = 0.02 * kPi / 180, kMostRounding = 0.5 * kPi / 180;
/// A rounding of all coordinates turns a triangle by up to so many roundings over its height.
constexpr double kRoundings = 4;

enum class Bend : std::uint8_t { Unknown, Flat, Bent };

/// The unit normal of a triangle, and the angle by which rounding turns it.
struct Plane {
    Eigen::Vector3f normal;
    float error;
};

RawVector<Plane> planes_of(const Stars& stars, const Positions& positions, double rounding) {
    RawVector<Plane> planes(stars.triangles.size());
    parallel_for_rows(static_cast<std::int64_t>(planes.size()), [&](std::int32_t i) {
        const auto [a, b, c] = corners_of(positions, stars.triangles[i]);
        const Eigen::Vector3d vector = twice_vector_area(a, b, c);
        const double length = vector.norm(),
                     longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
        Plane& plane = planes[i];
        plane = {Eigen::Vector3f::Zero(), static_cast<float>(kPi)};
        if (!(length > kDegenerate * longest * longest)) return;
        plane.normal = (vector / length).cast<float>();
        plane.error = static_cast<float>(kRoundings * rounding * longest / length);
    });
    return planes;
}

Bend bend_between(const Plane& a, const Plane& b) {
    const double error = double{a.error} + double{b.error};
    if (!(error < kMostRounding)) return Bend::Unknown;
    const double turn = double{(a.normal - b.normal).norm()};
    return turn < kFlatAngle + error ? Bend::Flat : Bend::Bent;
}

/// Returns how the surface bends along the edge to each of Stars::neighbours.
RawVector<Bend> bends_of(const Stars& stars, const RawVector<Plane>& planes) {
    struct Side {
        std::array<std::uint32_t, 2> triangles{};
        std::uint32_t count = 0;
    };
    RawVector<Bend> bends(stars.neighbours.size());
    parallel_for_chunks(stars.count(), [&](std::int64_t begin, std::int64_t end) {
        std::vector<Side> sides;
        for (auto vertex = static_cast<std::int32_t>(begin); vertex < end; ++vertex) {
            const std::uint32_t first = stars.neighbour_begin[vertex];
            sides.assign(stars.neighbour_begin[vertex + 1] - first, {});
            for (auto i = stars.corner_begin[vertex]; i < stars.corner_begin[vertex + 1]; ++i) {
                for (const std::uint32_t place : stars.places[i]) {
                    Side& side = sides[place - first];
                    if (side.count < 2) side.triangles[side.count] = stars.corners[i] / 3;
                    ++side.count;
                }
            }
            for (std::size_t i = 0; i < sides.size(); ++i) {
                const auto [a, b] = sides[i].triangles;
                bends[first + i] =
                    sides[i].count == 2 ? bend_between(planes[a], planes[b]) : Bend::Unknown;
            }
        }
    });
    return bends;
}

}  // namespace

double variation_of_edges(const Stars& stars, const Positions& positions) {
    using Moments = Eigen::Array3d;  // number, lengths, squares
    const Moments none = Moments::Zero();
    const Moments sums =
        parallel_sum(stars.count(), none, [&](std::int64_t begin, std::int64_t end) {
            Moments sum = none;
            for (auto vertex = static_cast<std::int32_t>(begin); vertex < end; ++vertex) {
                for (auto i = stars.neighbour_begin[vertex]; i < stars.neighbour_begin[vertex + 1];
                     ++i) {
                    const double length =
                        (positions[stars.neighbours[i]] - positions[vertex]).norm();
                    sum += Moments(1, length, length * length);
                }
            }
            return sum;
        });
    const double mean = sums[1] / sums[0];
    return mean > 0 ? std::sqrt(std::max(0.0, sums[2] / sums[0] - mean * mean)) / mean : 0;
}

Flatness flatness_of(const Stars& stars, const Positions& positions, double rounding) {
    const RawVector<Bend> bends = bends_of(stars, planes_of(stars, positions, rounding));
    Flatness flatness;
    flatness.share.resize(positions.size());
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        const auto begin = bends.begin() + stars.neighbour_begin[vertex],
                   end = bends.begin() + stars.neighbour_begin[vertex + 1];
        const auto flat = static_cast<float>(std::count(begin, end, Bend::Flat)),
                   bent = static_cast<float>(std::count(begin, end, Bend::Bent));
        flatness.share[vertex] = flat > 0 ? flat / (flat + bent) : 0;
    });
    using Counts = Eigen::Array2d;  // of all edges, and of flat ones, each twice
    const Counts none = Counts::Zero();
    const Counts counts =
        parallel_sum(stars.count(), none, [&](std::int64_t begin, std::int64_t end) {
            Counts counted = none;
            for (auto vertex = static_cast<std::int32_t>(begin); vertex < end; ++vertex) {
                if (flatness.is_flat(vertex)) continue;
                for (auto i = stars.neighbour_begin[vertex]; i < stars.neighbour_begin[vertex + 1];
                     ++i) {
                    if (bends[i] == Bend::Unknown || flatness.is_flat(stars.neighbours[i]))
                        continue;
                    counted += Counts(1, bends[i] == Bend::Flat ? 1 : 0);
                }
            }
            return counted;
        });
    if (counts[0] > 0) flatness.edges = counts[1] / counts[0];
    return flatness;
}

}  // namespace tracked_mcf
