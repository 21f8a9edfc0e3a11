#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <vector>

#include "filter_tracked_mcf/core/clip.h"
#include "filter_tracked_mcf/core/cubature.h"

namespace tracked_mcf {

/// A cubature node in space, with the area it stands for.
struct WeightedPoint {
    Eigen::Vector3d point;
    double weight;
};

/// Calls visit(WeightedPoint) for the nodes of `rule` on every triangle of the polygon's fan, the
/// paper's split triangles. Which fan, depends only on the shape and on the numbering of the
/// triangle's corners, not on the axes, so that a mesh turned by 90 degrees is sampled alike.
template <class Visit>
void for_each_node(const Polygon& polygon, const std::array<Eigen::Vector3d, 3>& triangle,
                   const std::vector<CubatureNode>& rule, Visit&& visit);

/// Index of the polygon's point that is nearest to the triangle's first corner; if several are, of
/// those the nearest to the second, then to the third.
int fan_apex(const Polygon& polygon, const std::array<Eigen::Vector3d, 3>& triangle);

/// Area of a triangle.
inline double triangle_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            const Eigen::Vector3d& c) {
    return 0.5 * (b - a).cross(c - a).norm();
}

template <class Visit>
void for_each_node(const Polygon& polygon, const std::array<Eigen::Vector3d, 3>& triangle,
                   const std::vector<CubatureNode>& rule, Visit&& visit) {
    const int apex = polygon.size > 3 ? fan_apex(polygon, triangle) : 0;
    const auto point = [&](int i) -> const Eigen::Vector3d& {
        return polygon.points[(apex + i) % polygon.size];
    };
    for (int i = 2; i < polygon.size; ++i) {
        const double area = triangle_area(point(0), point(i - 1), point(i));
        for (const CubatureNode& node : rule) {
            visit(WeightedPoint{node.barycentric[0] * point(0) +
                                    node.barycentric[1] * point(i - 1) +
                                    node.barycentric[2] * point(i),
                                node.weight * area});
        }
    }
}

}  // namespace tracked_mcf
