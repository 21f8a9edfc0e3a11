// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/system/element_matrices.h"
#include "filter_tracked_mcf/core/mesh/measures.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "tests/support/elements.h"
#include "tests/support/shapes.h"
#include "tests/unit/flow/equation_4.h"

namespace tracked_mcf {
namespace {

TrackedElements bumpy_elements() {
    const TriangleMesh mesh = shapes::bumpy_sphere(10);
    return build_tracked_elements(mesh, enclosing_grid(mesh, 4), Cubature::ThreePoints);
}

/// Returns the systems of a step of this size.
ElementSystems assemble(const TrackedElements& elements, const Coefficients& displacement,
                        double step_size) {
    ElementSystems systems;
    assemble_elements(elements, displacement, step_size, true, systems);
    return systems;
}

/// A smooth displacement. X_t is invertible and far from an isometry.
Coefficients wobble(const TrackedElements& elements) {
    Coefficients displacement = identity_coefficients(elements);
    for (Eigen::Index i = 0; i < displacement.rows(); ++i) {
        const Eigen::RowVector3d p = displacement.row(i);
        displacement.row(i) << 0.9 * std::sin(0.5 * p[1]), 0.3 * p[0] + std::cos(0.4 * p[2]),
            0.2 * p[2] + std::sin(0.3 * p[0]);
    }
    return displacement;
}

void expect_paper(const TrackedElements& elements, const Coefficients& displacement) {
    const ElementSystems mass = assemble(elements, displacement, 0);
    const ElementSystems both = assemble(elements, displacement, 1);
    const Coefficients embedding = identity_coefficients(elements) + displacement;
    double area = 0;
    for (std::int32_t element = 0; element < elements.finest().element_count(); ++element) {
        Matrix83 x;
        for (int corner = 0; corner < 8; ++corner) {
            x.row(corner) = embedding.row(elements.finest().unknowns[element][corner]);
        }
        const Equation4 expected = integrate(elements, x, element);
        const Matrix83 stiffness_times_x = expected.stiffness * x;
        area += expected.area;
        EXPECT_LT((whole(mass.matrices[element]) - expected.mass).norm(),
                  1e-5 * expected.mass.norm());
        EXPECT_LT((whole(both.stiffnesses[element]) - expected.stiffness).norm(),
                  1e-5 * expected.stiffness.norm());
        const Matrix8 sum = expected.mass + expected.stiffness;
        EXPECT_LT((whole(both.matrices[element]) - sum).norm(), 1e-5 * sum.norm());
        for (int axis = 0; axis < 3; ++axis) {
            for (int corner = 0; corner < 8; ++corner) {
                EXPECT_NEAR(-both.right_sides(axis, 8 * element + corner),
                            stiffness_times_x(corner, axis), 1e-5 * stiffness_times_x.norm());
            }
        }
    }
    EXPECT_NEAR(mass.area, area, 1e-6 * area);
    EXPECT_EQ(mass.collapsed_samples, 0);
}

TEST(ElementMatrices, AreEquation4OfTheInitialSurface) {
    const TrackedElements elements = bumpy_elements();
    expect_paper(elements, Coefficients::Zero(elements.finest().unknown_count(), 3));
}

TEST(ElementMatrices, AreEquation4OfADeformedSurface) {
    const TrackedElements elements = bumpy_elements();
    expect_paper(elements, wobble(elements));
}

TEST(ElementMatrices, CollapsedSamplesContributeNothing) {
    const TrackedElements elements = bumpy_elements();
    const Coefficients to_a_point = -identity_coefficients(elements);
    Coefficients to_a_line = to_a_point;
    to_a_line.col(0).setZero();
    for (const Coefficients& collapse : {to_a_point, to_a_line}) {
        const ElementSystems systems = assemble(elements, collapse, 1);
        EXPECT_EQ(systems.collapsed_samples, elements.samples.size());
        EXPECT_EQ(systems.area, 0);
        for (const ElementMatrix& matrix : systems.matrices) EXPECT_EQ(whole(matrix).norm(), 0);
    }
}

}  // namespace
}  // namespace tracked_mcf
