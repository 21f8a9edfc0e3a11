#pragma once

#include <Eigen/Core>
#include <vector>

#include "filter_tracked_mcf/core/flow_parameters.h"

namespace tracked_mcf {

/// One node of a rule on a triangle.
struct CubatureNode {
    Eigen::Vector3d barycentric;  ///< sums to 1
    double weight;                ///< fraction of the triangle's area; a rule's sum to 1
};

/// The nodes of a rule, all inside the triangle, with positive weights. OnePoint: the centroid.
/// ThreePoints: half way between each corner and the centroid, exact to degree 2 (section 4.2).
/// Degree6: the symmetric 12-point rule of Dunavant ("High degree efficient symmetrical Gaussian
/// quadrature rules for the triangle", 1985), which stands for the paper's 11-point rule of the
/// same degree (Day and Taylor, 2007).
const std::vector<CubatureNode>& cubature_rule(Cubature cubature);

}  // namespace tracked_mcf
