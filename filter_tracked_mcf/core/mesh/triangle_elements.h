// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "filter_tracked_mcf/core/mesh/stars.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"

namespace tracked_mcf {

/// The squared lengths of a triangle's sides in some metric, each opposite to its corner.
template <class Scalar>
using SquaredSides = Eigen::Array<Scalar, 3, 1>;

/// Linear elements on a triangle. The stiffness between two corners is minus the weight of the
/// third one.
template <class Scalar>
struct TriangleElement {
    std::array<Scalar, 3> weights;  ///< of each corner: half its cotangent
    Scalar mass;                    ///< of each corner: a third of the area
};

using TriangleElements = RawVector<TriangleElement<float>>;

/// Returns four times a triangle's area (Heron), at least the root of `thinnest` times the sum of
/// the squares.
template <class Scalar>
Scalar four_areas_of(const SquaredSides<Scalar>& squares, Scalar thinnest = 0) {
    const Scalar square = squares.sum() * squares.sum();
    return std::sqrt(std::max(square - 2 * squares.square().sum(), thinnest * square));
}

/// Returns linear elements in the metric of these squared sides.
template <class Scalar>
TriangleElement<Scalar> triangle_element(const SquaredSides<Scalar>& squares, Scalar four_areas) {
    const Scalar sum = squares.sum(), eight_areas = 2 * four_areas;
    TriangleElement<Scalar> element;
    for (int k = 0; k < 3; ++k) element.weights[k] = (sum - 2 * squares[k]) / eight_areas;
    element.mass = four_areas / 12;
    return element;
}

/// Returns the flux of the positions through those sides of a triangle that are on the rim: the
/// integral of the test function of its corner times the derivative of X along the conormal.
Eigen::Vector3f rim_flux(const Stars& stars, std::uint32_t triangle, std::uint32_t corner,
                         const TriangleElement<float>& element, const Positions& positions);

/// Returns linear elements in the surface's own metric. The sides of a triangle are made longer,
/// all three by as much, until the sum of the two shorter ones exceeds the longest one by 3 % of
/// the shortest and a thousandth of the longest: the cotangents of needles would have no bound.
/// Triangles whose angles are at most 160 degrees and whose longest side is at most a thousand
/// shortest ones are taken as they are, for only then is the flow one by mean curvature (the
/// mollification of Sharp and Crane, "A Laplacian for Nonmanifold Triangle Meshes", 2020).
///
/// `densities` multiply the mass of each triangle; none if all are 1.
TriangleElements elements_in_own_metric(const Stars& stars, const Positions& positions,
                                        const std::vector<float>& densities);

}  // namespace tracked_mcf
