// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/system/pinches.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/support/elements.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

/// Two spheres. The displacement scales the second by `factor` about a point.
struct TwoSpheres {
    explicit TwoSpheres(double factor)
        : mesh(shapes::merged(shapes::geodesic_sphere(10),
                              shapes::transformed(shapes::geodesic_sphere(10),
                                                  Eigen::Affine3d(Eigen::Translation3d(3, 0, 0))))),
          elements(build_tracked_elements(Domain(mesh, BoundaryCondition::Locked),
                                          enclosing_grid(mesh, 4), Cubature::ThreePoints)) {
        const Coefficients identity = identity_coefficients(elements);
        Coefficients displacement = Coefficients::Zero(identity.rows(), 3);
        const double between = elements.grid.to_grid({1.5, 0, 0})[0];
        for (Eigen::Index i = 0; i < identity.rows(); ++i) {
            is_second.push_back(identity(i, 0) > between);
            if (is_second.back()) displacement.row(i) = (factor - 1) * identity.row(i);
        }
        assemble_elements(elements, displacement, {1, 1, FlowKind::Conformalized}, systems);
    }

    /// What VanishedComponents constrains, from nothing.
    std::vector<bool> constrained(double share) const {
        std::vector<std::uint8_t> marks(is_second.size(), 0);
        VanishedComponents(elements).constrain(systems, share, marks);
        return {marks.begin(), marks.end()};
    }

    TriangleMesh mesh;
    TrackedElements elements;
    ElementSystems systems;
    std::vector<bool> is_second;  ///< of every unknown
};

TEST(VanishedComponents, ConstrainsTheUnknownsOfTheVanishedComponentAlone) {
    const TwoSpheres spheres(1e-3);
    EXPECT_EQ(spheres.constrained(1e-5), spheres.is_second);
}

TEST(VanishedComponents, ConstrainsNothingWhileTheAreaIsAboveTheShare) {
    // Scaling by 0.1 leaves a hundredth of the area.
    const TwoSpheres spheres(0.1);
    const std::vector<bool> none(spheres.is_second.size(), false);
    EXPECT_EQ(spheres.constrained(0.0099), none);
    EXPECT_EQ(spheres.constrained(0.0101), spheres.is_second);
}

TEST(VanishedComponents, DoesNotTakeNaNForVanished) {
    const TwoSpheres spheres(std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(spheres.constrained(1e-5), std::vector<bool>(spheres.is_second.size(), false));
}

}  // namespace
}  // namespace tracked_mcf
