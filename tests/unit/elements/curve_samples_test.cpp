// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/elements/curve_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/elements.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

TrackedElements build(const TriangleMesh& mesh, int depth,
                      BoundaryCondition boundary = BoundaryCondition::Locked) {
    return build_tracked_elements(Domain(mesh, boundary), enclosing_grid(mesh, depth),
                                  Cubature::ThreePoints);
}

double sampled_length(const TrackedElements& elements) {
    double length = 0;
    for (const CurveSample& sample : elements.curve_samples) length += sample.weight;
    return length * elements.grid.cell_size;
}

Eigen::Vector3d position(const TrackedElements& elements, const CurveSample& sample) {
    const Eigen::Vector3d cell = cell_at(elements.finest().cells[sample.element]).cast<double>();
    return elements.grid.origin + elements.grid.cell_size * (cell + sample.local.cast<double>());
}

/// Length of the boundary, edge by edge.
double boundary_length(const TriangleMesh& mesh) {
    const std::vector<std::uint8_t> boundary = topology_of(mesh).boundary;
    double length = 0;
    for (std::size_t triangle = 0; triangle < boundary.size(); ++triangle) {
        const Triangle& t = mesh.triangles[triangle];
        for (int side = 0; side < 3; ++side) {
            if (!has_bit(boundary[triangle], side)) continue;
            length += (mesh.positions[t[side]] - mesh.positions[t[(side + 1) % 3]]).norm();
        }
    }
    return length;
}

TEST(CurveSamples, WeightsSumToTheLengthOfTheBoundary) {
    for (const TriangleMesh& mesh : {shapes::square(5), shapes::moebius_band(30, 4),
                                     shapes::annulus(24, 3, 0.4, 1), shapes::tube(20, 4, 1.5)}) {
        for (const int depth : {2, 5}) {
            const double expected = boundary_length(mesh);
            // Weights are single precision.
            EXPECT_NEAR(sampled_length(build(mesh, depth)), expected, 1e-6 * expected);
        }
    }
    EXPECT_TRUE(build(shapes::geodesic_sphere(5), 4).curve_samples.empty());
    EXPECT_TRUE(build(shapes::square(5), 4, BoundaryCondition::Free).curve_samples.empty());
}

TEST(CurveSamples, LieOnTheBoundaryWithOutwardUnitConormals) {
    // On an annulus the conormal points away from the centre outside, and towards it inside.
    const TrackedElements elements = build(shapes::annulus(200, 3, 0.4, 1), 5);
    for (const CurveSample& sample : elements.curve_samples) {
        const Eigen::Vector3d at = position(elements, sample);
        const double radius = at.norm();
        const bool outer = radius > 0.7;
        EXPECT_NEAR(radius, outer ? 1 : 0.4, 2e-4);
        const Eigen::Vector3d outward = (outer ? 1 : -1) * at / radius;
        EXPECT_NEAR(sample.conormal.cast<double>().dot(outward), 1, 2e-4);
        EXPECT_NEAR(sample.conormal.norm(), 1, 1e-6);
    }
}

TEST(CurveSamples, AreSortedByElement) {
    const TrackedElements elements = build(shapes::square(7), 5);
    EXPECT_TRUE(std::is_sorted(
        elements.curve_samples.begin(), elements.curve_samples.end(),
        [](const CurveSample& a, const CurveSample& b) { return a.element < b.element; }));
}

}  // namespace
}  // namespace tracked_mcf
