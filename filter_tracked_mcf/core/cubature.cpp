#include "filter_tracked_mcf/core/cubature.h"

namespace tracked_mcf {

namespace {

using Nodes = std::vector<CubatureNode>;

/// The three nodes that have two barycentric coordinates equal to `twice`.
void add_orbit(Nodes& nodes, double twice, double weight) {
    const double once = 1 - 2 * twice;
    nodes.push_back({{once, twice, twice}, weight});
    nodes.push_back({{twice, once, twice}, weight});
    nodes.push_back({{twice, twice, once}, weight});
}

/// The six nodes whose barycentric coordinates are the permutations of three numbers.
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

}  // namespace tracked_mcf
