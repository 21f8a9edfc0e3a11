// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "filter_tracked_mcf/core/flow/cells/clip.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/mesh/measures.h"

namespace tracked_mcf {

/// One node of a quadrature rule on a triangle.
struct CubatureNode {
    Eigen::Vector3d barycentric;  ///< sums to 1
    double weight;                ///< share of the triangle's area; a rule's weights sum to 1
};

/// Returns the nodes of a rule. They lie inside the triangle and have positive weights.
/// OnePoint: the centroid, exact to degree 1.
/// ThreePoints: half way between each corner and the centroid, exact to degree 2 (section 4.2).
/// Degree6: Dunavant's symmetric rule of 12 points ("High degree efficient symmetrical Gaussian
/// quadrature rules for the triangle", 1985). The paper uses the rule of 11 points of the same
/// degree by Day and Taylor (2007).
const std::vector<CubatureNode>& cubature_rule(Cubature cubature);

/// A quadrature point and the area it stands for.
struct WeightedPoint {
    Eigen::Vector3d point;
    double weight;
};

/// Returns the index of the polygon's point nearest to the triangle's corner opposite to its
/// longest side. Ties are decided by the distance to the next corner, then to the one after it.
int fan_apex(const Polygon& polygon, const std::array<Eigen::Vector3d, 3>& triangle);

/// Calls visit(WeightedPoint) for the nodes of `rule` on every triangle of the polygon's fan. These
/// triangles are the paper's split triangles. The fan depends only on the shape, not on the axes,
/// so a mesh turned by 90 degrees is sampled alike; where sides are equally long, also on the order
/// of the corners.
template <class Visit>
void for_each_node(const Polygon& polygon, const std::array<Eigen::Vector3d, 3>& triangle,
                   const std::vector<CubatureNode>& rule, Visit&& visit) {
    const int apex = polygon.size > 3 ? fan_apex(polygon, triangle) : 0;
    const Eigen::Vector3d& first = polygon.points[apex];
    int last = polygon.next(apex);
    for (int i = 2; i < polygon.size; ++i) {
        const Eigen::Vector3d& second = polygon.points[last];
        last = polygon.next(last);
        const Eigen::Vector3d& third = polygon.points[last];
        const double area = 0.5 * twice_vector_area(first, second, third).norm();
        for (const CubatureNode& node : rule) {
            visit(WeightedPoint{node.barycentric[0] * first + node.barycentric[1] * second +
                                    node.barycentric[2] * third,
                                node.weight * area});
        }
    }
}

}  // namespace tracked_mcf
