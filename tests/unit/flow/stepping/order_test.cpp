// SPDX-License-Identifier: GPL-3.0-or-later
// A step of order m takes x to x - hᵐ x, with h = (D + δS)⁻¹ δS.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <vector>

#include "filter_tracked_mcf/core/flow/stepping/paper_flow.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"
#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

FlowParameters of_order(int order) {
    FlowParameters p = parameters(3, 1e-2, 1);
    p.order = order;
    p.tolerance = 1e-8;
    return p;
}

/// Returns the embedding's coefficients after applying h to them `order` times, by dense matrices.
Dense apply_h(const PaperFlow& flow, int order) {
    const TrackedElements& elements = flow.elements();
    const double step_size = flow.report().step_size / std::pow(elements.grid.cell_size, 2);
    ElementSystems systems;
    assemble_elements(elements, Coefficients::Zero(elements.finest().unknown_count(), 3), step_size,
                      true, systems);
    const auto factors = assembled(elements.finest(), systems.matrices).ldlt();
    const Dense weighted_stiffness = assembled(elements.finest(), systems.stiffnesses);
    Dense x = identity_coefficients(elements);
    for (int i = 0; i < order; ++i) x = factors.solve(weighted_stiffness * x);
    return x;
}

TEST(Order, IsTheNumberOfTimesThatHIsApplied) {
    const TriangleMesh mesh = shapes::bumpy_sphere(10);
    for (int order = 1; order <= kMaximumOrder; ++order) {
        FlowParameters p = of_order(order);
        p.method = Method::Paper;
        p.cycles = 100;
        PaperFlow flow(paper_plan_of(mesh, p));
        const Coefficients expected = -apply_h(flow, order);
        ASSERT_TRUE(flow.step());
        TriangleMesh moved = mesh;
        flow.move_vertices(moved.positions);
        double error = 0, size = 0;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const Eigen::Vector3d displacement =
                flow.elements().grid.cell_size *
                evaluate_vertex(flow.elements(), expected, flow.elements().vertices[i]);
            error += (moved.positions[i] - mesh.positions[i] - displacement).squaredNorm();
            size += displacement.squaredNorm();
        }
        // The matrices are single precision, about 1e-7, and small elements amplify their rounding.
        EXPECT_LT(std::sqrt(error / size), 1e-3) << order;
        EXPECT_GT(std::sqrt(size / static_cast<double>(mesh.positions.size())), 1e-3) << order;
    }
}

TEST(Order, CountsTheIterationsOfAllSolves) {
    TriangleMesh first = shapes::bumpy_sphere(20), third = first;
    const StepReport of_first = evolve(first, of_order(1)).steps.front();
    const StepReport of_third = evolve(third, of_order(3)).steps.front();
    // The first solve of both is the same, and each of the other two takes an iteration at least.
    EXPECT_GE(of_third.solver_iterations, of_first.solver_iterations + 2);
    EXPECT_GT(of_third.residual_before, of_first.residual_before);
    EXPECT_TRUE(of_third.reached_tolerance);
}

TEST(Order, HigherOnesShrinkASphereLess) {
    // The coordinates of a sphere of radius 1 are eigenvectors of D⁻¹S with eigenvalue 2, so its
    // radius becomes 1 - hᵐ with h = 2δ / (1 + 2δ). The tolerance is that of the first order's
    // test, which is of the grid and the triangles.
    const TriangleMesh sphere = shapes::geodesic_sphere(40);
    for (int order = 1; order <= kMaximumOrder; ++order) {
        FlowParameters p = parameters(5, 0.05 / 4, 1);
        p.order = order;
        const double h = 0.1 / 1.1;
        for (const Eigen::Vector3d& position : evolved(sphere, p).positions) {
            EXPECT_NEAR(position.norm(), 1 - std::pow(h, order), 3e-4) << order;
        }
    }
}

TEST(Order, AnyMaySuitStepsTooSmallToSee) {
    // The right-hand side of each solve is smaller by the step size.
    for (const double step_size : {1e-13, 1e-17, 1e-24}) {
        FlowParameters p = parameters(0, step_size, 2);
        p.order = kMaximumOrder;
        TriangleMesh mesh = shapes::bumpy_sphere(8);
        EXPECT_EQ(evolve(mesh, p).stop, Stop::None) << step_size;
    }
}

TEST(Order, WorksWithEveryMethodFlowAndBoundary) {
    // A higher order moves the surface less, because h is between 0 and 1.
    const TriangleMesh cap = bumpy_cap(15);
    for (const Method method : {Method::Converged, Method::Paper}) {
        for (const FlowKind kind : {FlowKind::MeanCurvature, FlowKind::Conformalized}) {
            if (method == Method::Paper && kind == FlowKind::Conformalized) continue;
            for (const auto boundary : {BoundaryCondition::Locked, BoundaryCondition::Free}) {
                const auto moved = [&](int order) {
                    FlowParameters p = parameters(5, 1e-4, 2);
                    p.method = method;
                    p.flow = kind;
                    p.boundary = boundary;
                    p.order = order;
                    TriangleMesh after = cap;
                    const FlowReport report = evolve(after, p);
                    EXPECT_EQ(report.steps.size(), 2U);
                    return report.rms_displacement;
                };
                const double of_first = moved(1), of_second = moved(2);
                EXPECT_LT(of_second, of_first);
                EXPECT_GT(of_second, 0.01 * of_first);
            }
        }
    }
}

}  // namespace
}  // namespace tracked_mcf
