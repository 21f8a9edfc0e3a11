// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/turns.h"

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/pi.h"

namespace tracked_mcf {

namespace {

constexpr double kRadian = kPi / 180;

/// Returns the angle of a difference of unit normals, in degrees: the inverse of crease_of().
double angle_of(double chord) {
    return 2 * std::asin(std::min(chord / 2, 1.0)) / kRadian;
}

}  // namespace

double crease_of(double angle) {
    return 2 * std::sin(angle * kRadian / 2);
}

Turns::Turns(const Stars& stars, const Positions& positions, const Vectors& normals) {
    turns_.reserve(stars.triangles.size());
    for (const Triangle& t : stars.triangles) {
        const Eigen::Vector4f &a = normals[t[0]], &b = normals[t[1]], &c = normals[t[2]];
        const auto [p, q, r] = corners_of(positions, t);
        const float square =
            std::max({(a - b).squaredNorm(), (b - c).squaredNorm(), (c - a).squaredNorm()});
        turns_.push_back({std::sqrt(square), twice_vector_area(p, q, r).norm()});
        area_ += turns_.back().area;
    }
}

double Turns::share_of(double crease) const {
    double sharp = 0;
    for (const Turn& turn : turns_) {
        if (turn.chord >= crease) sharp += turn.area;
    }
    return area_ > 0 ? sharp / area_ : 0;
}

double Turns::median_angle() {
    std::sort(turns_.begin(), turns_.end(),
              [](const Turn& a, const Turn& b) { return a.chord < b.chord; });
    auto turn = turns_.begin();
    double left = area_ / 2 - turn->area;
    while (left > 0) left -= (++turn)->area;
    return angle_of(turn->chord);
}

}  // namespace tracked_mcf
