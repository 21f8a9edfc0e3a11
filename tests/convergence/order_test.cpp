// SPDX-License-Identifier: GPL-3.0-or-later
// The error of the paper's method is of second order in the cell size.

#include <gtest/gtest.h>

#include <cmath>

#include "filter_tracked_mcf/core/evolve.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_distance.h"

namespace tracked_mcf {
namespace {

TriangleMesh flowed(TriangleMesh mesh, int depth) {
    FlowParameters parameters;
    parameters.order = 1;
    parameters.method = Method::Paper;
    parameters.cycles = 30;  // so that the solver's error is negligible
    parameters.depth = depth;
    parameters.step_size = 4e-3;
    parameters.iterations = 2;
    EXPECT_EQ(evolve(mesh, parameters).steps.size(), 2U);
    return mesh;
}

// Compares depths on the same mesh, so that the mesh's own error cancels. Its triangles are smaller
// than the smallest cells. It is not a sphere, because any grid represents a sphere's displacement.
TEST(Order, IsTwoInTheCellSize) {
    const TriangleMesh mesh = shapes::bumpy_sphere(160);
    TriangleMesh coarse = flowed(mesh, 4);
    double first = 0, last = 0;
    for (const int depth : {5, 6, 7}) {
        TriangleMesh fine = flowed(mesh, depth);
        last = rms_distance(coarse, fine);
        if (first == 0) first = last;
        std::printf("depth %d to %d: %.3g\n", depth - 1, depth, last);
        coarse = std::move(fine);
    }
    EXPECT_GT(std::log2(first / last) / 2, 1.8);
}

}  // namespace
}  // namespace tracked_mcf
