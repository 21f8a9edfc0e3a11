// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/solver/element_multigrid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

/// Returns the factor by which a cycle reduces an error in the energy norm.
double error_left(int depth, float step) {
    ElementSystem system(shapes::geodesic_sphere(64), depth, step, {false, 0.01});
    const Field exact = random_field(system);
    Field right_side, x, product;
    const double before = system.multigrid.multiply(exact, right_side);
    system.multigrid.cycle(right_side, x);
    return std::sqrt(system.multigrid.multiply(exact - x, product) / before);
}

TEST(ElementMultigrid, ACycleReducesTheErrorIndependentlyOfDepthAndStep) {
    for (const int depth : {4, 5, 6}) {
        for (const float step : {1e-2F, 1.0F, 100.0F}) {
            EXPECT_LT(error_left(depth, step), 0.35) << depth << ' ' << step;
        }
    }
}

TEST(ElementMultigrid, KeepsConstrainedUnknownsAtZero) {
    // Every third unknown, wherever it is.
    ElementSystem system(shapes::bumpy_sphere(8), 4, 0.5F, {false, 0.01});
    std::vector<std::uint8_t> constrained = system.constrained.back();
    for (std::size_t i = 0; i < constrained.size(); i += 3) constrained[i] = 1;
    system.multigrid.constrain(constrained);
    system.multigrid.refresh(system.systems.matrices, 0.5);
    system.multigrid.assemble(system.systems.right_sides, system.right_side);
    const Dense a = assembled(system);
    Field x;
    system.multigrid.cycle(system.right_side, x);
    for (std::size_t i = 0; i < constrained.size(); ++i) {
        const auto unknown = static_cast<std::int32_t>(i);
        EXPECT_EQ(system.multigrid.free_unknowns()[i] != 0, constrained[i] == 0);
        if (constrained[i] == 0) continue;
        EXPECT_TRUE(a.row(unknown).isZero(0) && a.col(unknown).isZero(0));
        EXPECT_TRUE(x.col(unknown).isZero(0));
        EXPECT_TRUE(system.right_side.col(unknown).isZero(0));
    }
}

}  // namespace
}  // namespace tracked_mcf
