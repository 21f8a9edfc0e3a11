// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/elements/supports.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "tests/support/elements.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

TEST(Supports, AreasSumToEightTimesTheSurface) {
    // Each element belongs to the supports of its cell's eight functions.
    const TriangleMesh mesh = shapes::bumpy_sphere(12);
    const Grid grid = enclosing_grid(mesh, 4);
    const Supports supports =
        measure_supports(build_tracked_elements(mesh, grid, Cubature::ThreePoints));
    const double sum = std::accumulate(supports.area.begin(), supports.area.end(), 0.0);
    const double area = surface_area(mesh) / (grid.cell_size * grid.cell_size);
    EXPECT_NEAR(sum, 8 * area, 1e-5 * sum);
}

TEST(Supports, TheMassOfAFunctionInsideAGridPlaneIsFourNinths) {
    // In the plane the function is the product of two hats, and ∫ hat² = 2/3.
    const TriangleMesh square =
        shapes::transformed(shapes::square(8), Eigen::Affine3d(Eigen::Scaling(8.0)));
    const TrackedElements elements =
        build_tracked_elements(square, {Eigen::Vector3d(0, 0, -4), 1, 3}, Cubature::Degree6);
    const Supports supports = measure_supports(elements);
    const auto inside = std::count_if(supports.mass.begin(), supports.mass.end(),
                                      [](float mass) { return std::abs(mass - 4.0F / 9) < 1e-5F; });
    EXPECT_EQ(inside, 7 * 7);
}

TEST(Supports, FunctionsThatVanishOnTheSurfaceAreNegligible) {
    // The square lies in the lower faces of its cells: the functions at their upper corners, and no
    // others, vanish on it.
    const TriangleMesh square =
        shapes::transformed(shapes::square(8), Eigen::Affine3d(Eigen::Scaling(8.0)));
    const TrackedElements elements =
        build_tracked_elements(square, {Eigen::Vector3d(0, 0, -4), 1, 3}, Cubature::ThreePoints);
    std::vector<std::uint8_t> constrained(
        static_cast<std::size_t>(elements.finest().unknown_count()), 0);
    constrain_negligible(measure_supports(elements), constrained);
    const Coefficients corners = identity_coefficients(elements);
    for (std::size_t unknown = 0; unknown < constrained.size(); ++unknown) {
        const double height = corners(static_cast<Eigen::Index>(unknown), 2);
        EXPECT_EQ(constrained[unknown] != 0, height == 5) << height;
    }
}

}  // namespace
}  // namespace tracked_mcf
