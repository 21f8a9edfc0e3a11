// SPDX-License-Identifier: GPL-3.0-or-later
// Bad meshes on which the solver's error at single vertices was once much larger than its
// tolerance. The results then depended on the order of the vertices.

#include <gtest/gtest.h>

#include "tests/support/shapes.h"
#include "tests/zoo/case_run.h"
#include "tests/zoo/properties.h"

namespace tracked_mcf::zoo {
namespace {

TriangleMesh sphere_at(const Eigen::Vector3d& centre, double radius, int frequency) {
    return shapes::transformed(shapes::bumpy_sphere(frequency),
                               Eigen::Translation3d(centre) * Eigen::Scaling(radius));
}

/// Expects all properties, and that each vertex is where an exact solver takes it, up to ten
/// tolerances of the largest displacement for each solve, and single precision.
void expect_solved(const Case& usual) {
    Case exact = usual;
    exact.parameters.tolerance = 1e-9;
    const Run of_usual = run(usual), of_exact = run(exact);
    const double solves = usual.parameters.order * usual.parameters.iterations;
    const double diagonal =
        box_of(usual.mesh, vertices_of(usual.mesh, usual.inputs.selection)).diagonal().norm();
    const double bound =
        10 * solves * usual.parameters.tolerance * of_exact.report.largest_displacement +
        1e-5 * diagonal;
    for (std::size_t i = 0; i < usual.mesh.positions.size(); ++i) {
        EXPECT_LE((of_usual.mesh.positions[i] - of_exact.mesh.positions[i]).norm(), bound) << i;
    }
    for (const Case& of : {usual, exact}) {
        Random random(1, 0);
        for (const Failure& failure : check(of, true, random).failures) {
            ADD_FAILURE() << kPropertyNames[static_cast<std::size_t>(failure.property)] << ": "
                          << failure.what;
        }
    }
    EXPECT_EQ(of_exact.report.steps.size(), static_cast<std::size_t>(usual.parameters.iterations));
    for (const StepReport& step : of_exact.report.steps) EXPECT_TRUE(step.reached_tolerance);
}

TEST(Regression, SpheresOfAllSizes) {
    Case made;
    made.mesh = sphere_at({-0.3, -0.1, -0.1}, 0.4, 4);
    double radius = 1e-2;
    for (const double x : {0.1, 0.3, 0.5, 0.7, 0.9}) {
        made.mesh = shapes::merged(made.mesh, sphere_at({x, -x * x, 0.3 - x}, radius, 3));
        radius /= 100;
    }
    made.parameters.flow = FlowKind::Conformalized;
    made.parameters.order = 4;
    made.parameters.step_size = 4e-6;
    made.parameters.iterations = 3;
    expect_solved(made);
}

TEST(Regression, DumbbellWithAThinHandle) {
    Case made;
    const TriangleMesh balls =
        shapes::merged(sphere_at({0, 0, -3}, 1, 5), sphere_at({0, 0, 3}, 1, 5));
    const Eigen::Affine3d thin(Eigen::Scaling(1.6e-3, 1.6e-3, 1.0));
    made.mesh = shapes::merged(shapes::transformed(shapes::tube(10, 19, 6), thin), balls);
    for (const Triangle& t : made.mesh.triangles) {
        made.inputs.selection.push_back(made.mesh.positions[t[0]].x() > -0.2 ? 1 : 0);
    }
    made.parameters.flow = FlowKind::Conformalized;
    made.parameters.order = 1;
    made.parameters.step_size = 9.5;
    made.parameters.iterations = 1;
    expect_solved(made);
}

}  // namespace
}  // namespace tracked_mcf::zoo
