// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/triangle_elements.h"

#include <algorithm>
#include <cmath>

namespace tracked_mcf {

namespace {

/// The least slack of a triangle, in local edge lengths: the sum of two of its sides less the third
/// one.
constexpr double kLeastSlack = 0.03;

/// The least local edge length, in units of the surface. Where it has collapsed to a point,
/// cotangents stay finite.
constexpr float kLeastEdge = 1e-6F;

/// Local squares of edge lengths are means over so many steps of diffusion: the vertices two sides
/// away.
constexpr int kStepsOfMean = 2;

/// Returns, per vertex, the mean square of the sides around it.
std::vector<float> local_squares(const Stars& stars,
                                 const std::vector<Eigen::Vector3d>& positions) {
    std::vector<float> squares(static_cast<std::size_t>(stars.count()));
    std::vector<float> counts(squares.size());
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        const std::uint32_t begin = stars.neighbour_begin[vertex];
        const std::uint32_t end = stars.neighbour_begin[vertex + 1];
        double sum = 0;
        for (std::uint32_t i = begin; i < end; ++i) {
            sum += (positions[stars.neighbours[i]] - positions[vertex]).squaredNorm();
        }
        squares[vertex] = static_cast<float>(sum);
        counts[vertex] = static_cast<float>(end - begin);
    });
    diffuse(stars, kStepsOfMean, squares);
    diffuse(stars, kStepsOfMean, counts);
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        squares[vertex] = std::max(squares[vertex] / counts[vertex], kLeastEdge * kLeastEdge);
    });
    return squares;
}

}  // namespace

TriangleElements elements_in_own_metric(const Stars& stars,
                                        const std::vector<Eigen::Vector3d>& positions,
                                        const std::vector<float>& densities) {
    const std::vector<float> squares = local_squares(stars, positions);
    TriangleElements elements(stars.triangles.size());
    parallel_for_rows(static_cast<std::int64_t>(elements.size()), [&](std::int32_t i) {
        const auto& [a, b, c] = stars.triangles[i];
        Eigen::Array3d sides((positions[b] - positions[c]).norm(),
                             (positions[c] - positions[a]).norm(),
                             (positions[a] - positions[b]).norm());
        const double edge = std::sqrt((squares[a] + squares[b] + squares[c]) / 3);
        const double slack = sides.sum() - 2 * sides.maxCoeff();
        sides += std::max(0.0, kLeastSlack * edge - slack);
        // Heron's formula from the differences, which keeps the digits of needles.
        const Eigen::Array3d rests = sides.sum() - 2 * sides;
        const double four_areas = std::sqrt(sides.sum() * rests.prod());
        const Eigen::Array3d of_sides = sides.square();
        for (int k = 0; k < 3; ++k) {
            elements[i].weights[k] =
                static_cast<float>((of_sides.sum() - 2 * of_sides[k]) / (2 * four_areas));
        }
        const double density = densities.empty() ? 1 : densities[i];
        elements[i].mass = static_cast<float>(density * four_areas / 12);
    });
    return elements;
}

}  // namespace tracked_mcf
