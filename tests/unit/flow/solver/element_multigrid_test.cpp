// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/element_multigrid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

/// Returns the factor by which a cycle reduces an error in the energy norm.
double error_left(int depth, double step) {
    const LevelSystem system = vertex_system(shapes::geodesic_sphere(64), depth, step);
    ElementMultigrid multigrid(system.levels);
    multigrid.refresh(system.matrices, step);
    const Field exact = random_field(system.finest());
    const Field right_side = times(system, exact);
    Field x;
    multigrid.cycle(right_side, x);
    const Field error = exact - x;
    return std::sqrt(dot(error, times(system, error)).sum() / dot(exact, right_side).sum());
}

TEST(ElementMultigrid, ACycleReducesTheErrorIndependentlyOfDepthAndStep) {
    for (const int depth : {4, 5, 6}) {
        for (const double step : {1e-2, 1.0, 100.0}) {
            EXPECT_LT(error_left(depth, step), 0.35) << depth << ' ' << step;
        }
    }
}

}  // namespace
}  // namespace tracked_mcf
