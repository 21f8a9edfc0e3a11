// SPDX-License-Identifier: GPL-3.0-or-later
// Rotations and the flow commute: on the mesh up to the solver's error, with the paper's method up
// to that of the grid, which does not rotate.

#include <gtest/gtest.h>

#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/mesh/grid.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_distance.h"

namespace tracked_mcf {
namespace {

/// Returns the root mean square distance between flowing the turned mesh and turning the flowed
/// mesh.
double disagreement(const TriangleMesh& mesh, const Eigen::Affine3d& turn, Method method,
                    int depth) {
    const auto flowed = [&](TriangleMesh m) {
        FlowParameters parameters;
        parameters.order = 1;
        parameters.method = method;
        parameters.cycles = 20;
        parameters.depth = depth;
        parameters.iterations = 3;
        parameters.step_size = 1e-3;
        evolve(m, parameters);
        return m;
    };
    return rms_distance(flowed(shapes::transformed(mesh, turn)),
                        shapes::transformed(flowed(mesh), turn));
}

TEST(Rotation, CommutesToTheDiscretisationError) {
    const TriangleMesh mesh = shapes::bumpy_sphere(60);
    const Eigen::Affine3d turn(Eigen::AngleAxisd(0.6, Eigen::Vector3d(1, 2, 3).normalized()));
    double previous = 0;
    for (const int depth : {2, 3, 4}) {
        const double error = disagreement(mesh, turn, Method::Paper, depth);
        std::printf("depth %d: %.2e\n", depth, error);
        if (previous > 0) {
            EXPECT_LT(error, 0.4 * previous) << depth;
        }
        previous = error;
    }
    // The mesh turns with itself: what is left is the solver's error.
    const double error = disagreement(mesh, turn, Method::Converged, 0);
    std::printf("on the mesh: %.2e\n", error);
    EXPECT_LT(error, 2e-5);
    EXPECT_LT(error, 0.1 * disagreement(mesh, turn, Method::Paper, 4));
}

}  // namespace
}  // namespace tracked_mcf
