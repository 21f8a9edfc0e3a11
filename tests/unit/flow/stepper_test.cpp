// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/stepper.h"

#include <gtest/gtest.h>

#include "filter_tracked_mcf/core/flow/flow.h"
#include "tests/support/plans.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

/// Returns the state after a step that must succeed.
FlowState stepped(Stepper& stepper, const FlowState& from, double share = 1) {
    StepReport report;
    stepper.forget_solutions();
    return std::get<FlowState>(stepper.advance(from, share * stepper.size(), {1e-6}, report));
}

TEST(Stepper, AStepIsAFunctionOfItsState) {
    FlowParameters p = parameters(5, 2e-3, 1);
    p.quality = Quality::MeanCurvature;
    const TriangleMesh cap = bumpy_cap(12);
    Stepper stepper = stepper_of(plan_of(cap, p));
    const FlowState start = stepper.start();
    const FlowState first = stepped(stepper, start);
    const FlowState second = stepped(stepper, first);
    EXPECT_NE(first.multipliers, second.multipliers);
    // Attempts that are abandoned leave nothing in the next one.
    stepped(stepper, stepped(stepper, second, 0.25), 0.25);
    const FlowState again = stepped(stepper, first);
    EXPECT_EQ(again.multipliers, second.multipliers);
    EXPECT_EQ(again.constrained, second.constrained);
    EXPECT_LT((again.displacement - second.displacement).norm(), 1e-5 * second.displacement.norm());
    EXPECT_LT((again.velocity - second.velocity).norm(), 1e-5 * second.velocity.norm());
}

TEST(Stepper, PinchedUnknownsBelongToTheStateThatHasPinched) {
    // A dumbbell's thin bar pinches in a few steps, long before the balls vanish.
    TriangleMesh mesh = shapes::geodesic_sphere(20);
    for (auto& p : mesh.positions) {
        const double waist = 0.06 + 0.94 * p[0] * p[0];
        p = Eigen::Vector3d(2 * p[0], waist * p[1], waist * p[2]);
    }
    Stepper stepper = stepper_of(plan_of(mesh, parameters(5, 2e-4, 1)));
    const FlowState start = stepper.start();
    FlowState state = start;
    for (int i = 0; i < 40 && state.constrained == start.constrained; ++i) {
        state = stepped(stepper, state);
    }
    ASSERT_NE(state.constrained, start.constrained);
    EXPECT_EQ(stepped(stepper, start).constrained, start.constrained);
}

}  // namespace
}  // namespace tracked_mcf
