// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/cells/cubature.h"

#include <cmath>

namespace tracked_mcf {

namespace {

using Nodes = std::vector<CubatureNode>;

/// Adds the three nodes with two barycentric coordinates equal to `twice`.
void add_orbit(Nodes& nodes, double twice, double weight) {
    const double once = 1 - 2 * twice;
    nodes.push_back({{once, twice, twice}, weight});
    nodes.push_back({{twice, once, twice}, weight});
    nodes.push_back({{twice, twice, once}, weight});
}

/// Adds the six nodes whose barycentric coordinates are the permutations of a, b and 1 - a - b.
void add_orbit(Nodes& nodes, double a, double b, double weight) {
    const double c = 1 - a - b;
    nodes.push_back({{a, b, c}, weight});
    nodes.push_back({{b, c, a}, weight});
    nodes.push_back({{c, a, b}, weight});
    nodes.push_back({{a, c, b}, weight});
    nodes.push_back({{c, b, a}, weight});
    nodes.push_back({{b, a, c}, weight});
}

Nodes three_points() {
    Nodes nodes;
    add_orbit(nodes, 1.0 / 6, 1.0 / 3);
    return nodes;
}

Nodes degree_6() {
    Nodes nodes;
    add_orbit(nodes, 0.249286745170910, 0.116786275726379);
    add_orbit(nodes, 0.063089014491502, 0.050844906370207);
    add_orbit(nodes, 0.053145049844816, 0.310352451033785, 0.082851075618374);
    return nodes;
}

/// Squared distances that differ by less count as equal, so that rounding does not choose the fan.
constexpr double kTie = 1e-9;

using Corners = std::array<Eigen::Vector3d, 3>;

/// Returns the corners of a triangle from the one opposite to the longest side on.
Corners by_opposite_side(const Corners& corners) {
    const auto& [a, b, c] = corners;
    const std::array<double, 3> squares = {(b - c).squaredNorm(), (c - a).squaredNorm(),
                                           (a - b).squaredNorm()};
    int first = 0;
    for (int i = 1; i < 3; ++i) {
        if (squares[i] > squares[first] + kTie) first = i;
    }
    return {corners[first], corners[(first + 1) % 3], corners[(first + 2) % 3]};
}

bool nearer(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const Corners& corners) {
    for (const Eigen::Vector3d& corner : corners) {
        const double difference = (p - corner).squaredNorm() - (q - corner).squaredNorm();
        if (difference < -kTie) return true;
        if (difference > kTie) return false;
    }
    return false;
}

}  // namespace

const std::vector<CubatureNode>& cubature_rule(Cubature cubature) {
    static const Nodes one = {{Eigen::Vector3d::Constant(1.0 / 3), 1.0}};
    static const Nodes three = three_points();
    static const Nodes many = degree_6();
    switch (cubature) {
        case Cubature::OnePoint:
            return one;
        case Cubature::ThreePoints:
            return three;
        case Cubature::Degree6:
            return many;
    }
    return three;
}

int fan_apex(const Polygon& polygon, const std::array<Eigen::Vector3d, 3>& triangle) {
    const Corners corners = by_opposite_side(triangle);
    int apex = 0;
    for (int i = 1; i < polygon.size; ++i) {
        if (nearer(polygon.points[i], polygon.points[apex], corners)) apex = i;
    }
    return apex;
}

}  // namespace tracked_mcf
