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
double relative_error(TriangleMesh mesh,
                      const std::function<double(const Eigen::Vector3d&)>& exact) {
    FlowParameters parameters;
    parameters.iterations = 1;
    parameters.step_size = 1e-12;  // moves nothing that shows
    parameters.quality = Quality::MeanCurvature;
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

/// Expects that the error falls with the square of the edges, which are halved twice.
void expect_second_order(const char* name, const std::function<TriangleMesh(int)>& refined,
                         const std::function<double(const Eigen::Vector3d&)>& exact) {
    double first = 0, last = 0;
    for (const int refinement : {1, 2, 4}) {
        last = relative_error(refined(refinement), exact);
        if (refinement == 1) first = last;
        std::printf("%s, refined %d times: RMS error of the mean curvature %.2e\n", name,
                    refinement, last);
    }
    EXPECT_GE(std::log2(first / last) / 2, 1.5);
}

TEST(MeanCurvature, OfTheUnitSphere) {
    // The cotangents' own error at a vertex does not fall with the edges, and smoothing leaves a
    // little of it.
    for (const int frequency : {20, 40, 80}) {
        const double error =
            relative_error(shapes::geodesic_sphere(frequency), [](const auto&) { return 1.0; });
        std::printf("sphere of frequency %d: RMS error of the mean curvature %.2e\n", frequency,
                    error);
        EXPECT_LT(error, 2e-3);
    }
}

TEST(MeanCurvature, OfATorus) {
    expect_second_order(
        "torus",
        [](int refinement) {
            return shapes::torus(120 * refinement, 48 * refinement, kRadius, kTubeRadius);
        },
        of_torus);
}

}  // namespace
}  // namespace tracked_mcf
