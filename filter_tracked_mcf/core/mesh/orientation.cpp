// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/orientation.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"

namespace tracked_mcf {

namespace {

/// Tells which side of another triangle a side shares its edge with. A side is a number, 3 ×
/// triangle + corner, where it begins.
class OtherSides {
public:
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    explicit OtherSides(const Stars& stars)
        : edges_(stars.corners.size()), sides_(stars.neighbours.size(), {kNone, kNone}) {
        for (std::int32_t vertex = 0; vertex < stars.count(); ++vertex) {
            for (auto i = stars.corner_begin[vertex]; i < stars.corner_begin[vertex + 1]; ++i) {
                const std::uint32_t begins = stars.corners[i];
                const std::uint32_t ends = begins - begins % 3 + (begins + 2) % 3;
                for (const auto& [side, edge] :
                     {std::pair(begins, stars.places[i][0]), std::pair(ends, stars.places[i][1])}) {
                    if (stars.neighbours[edge] > vertex) add(side, edge);
                }
            }
        }
    }

    /// Returns kNone on the rim, and where more than two triangles meet: none continues another.
    std::uint32_t of(std::uint32_t side) const {
        const auto& [first, second] = sides_[edges_[side]];
        return first == side ? second : second == side ? first : kNone;
    }

private:
    void add(std::uint32_t side, std::uint32_t edge) {
        edges_[side] = edge;
        auto& [first, second] = sides_[edge];
        if (first == kNone) {
            first = side;
        } else if (second == kNone && first != kMany) {
            second = side;
        } else {
            first = kMany;
            second = kNone;
        }
    }

    static constexpr std::uint32_t kMany = kNone - 1;

    RawVector<std::uint32_t> edges_;  ///< per side: the entry of its edge at the smaller vertex
    std::vector<std::array<std::uint32_t, 2>> sides_;  ///< per entry of an edge
};

}  // namespace

void orient_alike(Surface& surface, const std::vector<Directions>& directions) {
    const Stars& stars = surface.stars;
    RawVector<Triangle> triangles = stars.triangles;
    const OtherSides others(stars);
    const auto begin_of = [&](std::uint32_t side) { return triangles[side / 3][side % 3]; };
    enum State : std::uint8_t { AsItIs, Turned, Unknown };
    std::vector<std::uint8_t> states(triangles.size(), Unknown);
    std::vector<std::uint32_t> alike;
    for (std::uint32_t first = 0; first < states.size(); ++first) {
        if (states[first] != Unknown) continue;
        states[first] = AsItIs;
        alike.assign(1, first);
        std::array<double, 2> areas = {0, 0};  // as they are, turned
        double volume = 0;                     // six times that inside, as they are
        for (std::size_t visited = 0; visited < alike.size(); ++visited) {
            const std::uint32_t t = alike[visited];
            for (std::uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
                const std::uint32_t other = others.of(side);
                if (other == OtherSides::kNone || states[other / 3] != Unknown) continue;
                // Sides of triangles that are oriented alike run against each other.
                const bool is_alike = begin_of(side) != begin_of(other);
                states[other / 3] = is_alike ? states[t] : Turned - states[t];
                alike.push_back(other / 3);
            }
            const auto [a, b, c] = corners_of(surface.positions, stars.triangles[t]);
            const Eigen::Vector3d normal = twice_vector_area(a, b, c);
            volume += states[t] == AsItIs ? a.dot(normal) : -a.dot(normal);
            if (directions.empty() || directions[t] != Directions::Even)
                areas[states[t]] += normal.norm();
            poll_progress();
        }
        const bool turns = areas[0] == areas[1] ? volume < 0 : areas[1] > areas[0];
        const State wrong = turns ? AsItIs : Turned;
        for (const std::uint32_t t : alike) states[t] = states[t] == wrong ? Turned : AsItIs;
    }
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        if (states[i] == Turned) std::swap(triangles[i][1], triangles[i][2]);
    }
    surface.stars = Stars(std::move(triangles), stars.count());
}

}  // namespace tracked_mcf
