// SPDX-License-Identifier: GPL-3.0-or-later
// The mean curvature that a flow measures, against the exact one, over the depth of the octree.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>

#include "filter_tracked_mcf/core/evolve.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

constexpr double kRadius = 1, kTubeRadius = 0.4;

/// The mean curvature of the torus at a point.
double of_torus(const Eigen::Vector3d& point) {
    const double distance = std::hypot(point.x(), point.y());
    const double cosine = (distance - kRadius) / kTubeRadius;
    return (1 / kTubeRadius + cosine / distance) / 2;
}

/// Returns the root mean square of the error at the vertices, relative to that of the curvature.
double relative_error(TriangleMesh mesh, int depth,
                      const std::function<double(const Eigen::Vector3d&)>& exact) {
    FlowParameters parameters;
    parameters.depth = depth;
    parameters.iterations = 1;
    parameters.quality = Quality::MeanCurvature;
    // Four cells: what the step itself smooths vanishes with the cells, too.
    parameters.detail_size = 4 * 2.1 * (kRadius + kTubeRadius) / (1 << depth);
    const TriangleMesh before = mesh;
    const std::vector<double> measured = evolve(mesh, parameters).quality;
    double errors = 0, squares = 0;
    for (std::size_t i = 0; i < measured.size(); ++i) {
        const double curvature = exact(before.positions[i]);
        errors += std::pow(measured[i] - curvature, 2);
        squares += curvature * curvature;
    }
    return std::sqrt(errors / squares);
}

/// At the greatest depth, the edges of the meshes below begin to show.
void expect_second_order(const char* name, const TriangleMesh& mesh,
                         const std::function<double(const Eigen::Vector3d&)>& exact) {
    double first = 0, last = 0;
    for (int depth = 4; depth <= 7; ++depth) {
        last = relative_error(mesh, depth, exact);
        if (depth == 4) first = last;
        std::printf("%s, depth %d: RMS error of the mean curvature %.2e\n", name, depth, last);
    }
    EXPECT_GE(std::log2(first / last) / 3, 1.5);
}

TEST(MeanCurvature, OfTheUnitSphere) {
    expect_second_order("sphere", shapes::geodesic_sphere(192), [](const auto&) { return 1.0; });
}

TEST(MeanCurvature, OfATorus) {
    expect_second_order("torus", shapes::torus(960, 384, kRadius, kTubeRadius), of_torus);
}

}  // namespace
}  // namespace tracked_mcf
