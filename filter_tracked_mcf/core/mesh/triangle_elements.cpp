// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/triangle_elements.h"

#include <algorithm>
#include <cmath>

namespace tracked_mcf {

namespace {

/// The least slack of a triangle, in shortest sides: the sum of the two shorter sides less the
/// longest one. Angles of up to 160 to 166 degrees have more.
constexpr double kLeastSlack = 0.03;

/// The least slack in longest sides. It bounds the cotangents where the shortest side vanishes.
constexpr double kThinnestNeedle = 1e-3;

/// The least slack in units of the surface. Where it has collapsed to a point, cotangents stay
/// finite.
constexpr double kLeastSide = 1e-6;

}  // namespace

Eigen::Vector3f rim_flux(const Stars& stars, std::uint32_t triangle, std::uint32_t corner,
                         const TriangleElement<float>& element, const Positions& positions) {
    const Triangle& t = stars.triangles[triangle];
    Eigen::Vector3f flux = Eigen::Vector3f::Zero();
    for (const std::uint32_t side : {corner, (corner + 2) % 3}) {
        if (stars.rim_sides[3 * std::size_t{triangle} + side] == 0) continue;
        const std::uint32_t other = side == corner ? (corner + 1) % 3 : side;
        const Eigen::Vector3d& inside = positions[t[3 - corner - other]];
        flux += element.weights[other] * (positions[t[corner]] - inside).cast<float>() +
                element.weights[corner] * (positions[t[other]] - inside).cast<float>();
    }
    return flux;
}

TriangleElements elements_in_own_metric(const Stars& stars, const Positions& positions,
                                        const std::vector<float>& densities) {
    TriangleElements elements(stars.triangles.size());
    parallel_for_rows(static_cast<std::int64_t>(elements.size()), [&](std::int32_t i) {
        const auto& [a, b, c] = stars.triangles[i];
        Eigen::Array3d sides((positions[b] - positions[c]).norm(),
                             (positions[c] - positions[a]).norm(),
                             (positions[a] - positions[b]).norm());
        const double longest = sides.maxCoeff();
        const double least =
            std::max({kLeastSlack * sides.minCoeff(), kThinnestNeedle * longest, kLeastSide});
        sides += std::max(0.0, least - (sides.sum() - 2 * longest));
        // Heron's formula from the differences, which keeps the digits of needles.
        const Eigen::Array3d rests = sides.sum() - 2 * sides;
        const double four_areas = std::sqrt(sides.sum() * rests.prod());
        const auto element = triangle_element<double>(sides.square(), four_areas);
        for (int k = 0; k < 3; ++k) elements[i].weights[k] = static_cast<float>(element.weights[k]);
        const double density = densities.empty() ? 1 : densities[i];
        elements[i].mass = static_cast<float>(density * element.mass);
    });
    return elements;
}

}  // namespace tracked_mcf
