// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/system/element_matrices.h"
#include "filter_tracked_mcf/core/mesh/measures.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>

#include "filter_tracked_mcf/core/flow/cells/bspline.h"
#include "tests/support/bspline_gradients.h"
#include "tests/support/elements.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

using Matrix8 = Eigen::Matrix<double, 8, 8>;

Matrix8 to_matrix(const MatrixBlocks& matrices, std::int64_t element) {
    const ElementMatrix whole = matrices.of(element);
    return Eigen::Map<const Eigen::Matrix<float, 8, 8>>(whole.entry[0]).cast<double>();
}

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

/// Equation 4 for one element as in the paper, in double precision: the metric from the embedding's
/// coefficients, then a sum over the samples.
struct Reference {
    Matrix8 mass = Matrix8::Zero();
    Matrix8 stiffness = Matrix8::Zero();
    Eigen::Matrix<double, 8, 3> stiffness_times_x = Eigen::Matrix<double, 8, 3>::Zero();
    double area = 0;
};
Reference integrate(const TrackedElements& elements, const Coefficients& embedding,
                    std::int32_t element) {
    Eigen::Matrix<double, 8, 3> x;
    for (int corner = 0; corner < 8; ++corner) {
        x.row(corner) = embedding.row(elements.finest().unknowns[element][corner]);
    }
    Reference reference;
    std::int64_t sample = elements.sample_begin[element];
    for (std::int64_t f = elements.fragment_begin[element];
         f < elements.fragment_begin[element + 1]; ++f) {
        const Fragment& fragment = elements.fragments[f];
        const Eigen::Vector3d normal =
            Eigen::Map<const Eigen::Vector3f>(fragment.normal).cast<double>();
        Eigen::Matrix<double, 3, 2> tangents;
        tangents.col(0) = normal.unitOrthogonal();
        tangents.col(1) = normal.normalized().cross(tangents.col(0));
        for (std::int32_t i = 0; i < fragment.sample_count; ++i, ++sample) {
            const Eigen::Vector3d local = elements.samples.local(sample);
            const CornerValues beta = bspline_values(local);
            const Eigen::Matrix<double, 8, 2> eta = bspline_gradients(local) * tangents;
            const Eigen::Matrix<double, 3, 2> dx = x.transpose() * eta;
            const Eigen::Matrix2d g = dx.transpose() * dx;
            const double weight = std::sqrt(g.determinant()) * elements.samples.weight(sample);
            reference.mass += weight * beta * beta.transpose();
            reference.stiffness += weight * eta * g.inverse() * eta.transpose();
            reference.area += weight;
        }
    }
    reference.stiffness_times_x = reference.stiffness * x;
    return reference;
}

void expect_paper(const TrackedElements& elements, const Coefficients& displacement) {
    const ElementSystems mass = assemble(elements, displacement, 0);
    const ElementSystems both = assemble(elements, displacement, 1);
    const Coefficients embedding = identity_coefficients(elements) + displacement;
    double area = 0;
    for (std::int32_t element = 0; element < elements.finest().element_count(); ++element) {
        const Reference expected = integrate(elements, embedding, element);
        area += expected.area;
        EXPECT_LT((to_matrix(mass.matrices, element) - expected.mass).norm(),
                  1e-5 * expected.mass.norm());
        EXPECT_LT((to_matrix(both.stiffnesses, element) - expected.stiffness).norm(),
                  1e-5 * expected.stiffness.norm());
        const Matrix8 sum = expected.mass + expected.stiffness;
        EXPECT_LT((to_matrix(both.matrices, element) - sum).norm(), 1e-5 * sum.norm());
        for (int axis = 0; axis < 3; ++axis) {
            for (int corner = 0; corner < 8; ++corner) {
                EXPECT_NEAR(-both.right_sides[element].entry[axis][corner],
                            expected.stiffness_times_x(corner, axis),
                            1e-5 * expected.stiffness_times_x.norm());
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

/// Expects that b is `scale` times a.
void expect_same(const MatrixBlocks& a, const MatrixBlocks& b, double scale) {
    for (std::int64_t element = 0; element < a.size(); ++element) {
        const Matrix8 expected = scale * to_matrix(a, element);
        EXPECT_LT((to_matrix(b, element) - expected).norm(), 2e-5 * expected.norm());
    }
}

/// Expects that the masses of two embeddings have this ratio, and that their stiffnesses are equal.
void expect_scaled(const TrackedElements& elements, const Coefficients& a, const Coefficients& b,
                   double ratio) {
    expect_same(assemble(elements, a, 0).matrices, assemble(elements, b, 0).matrices, ratio);
    expect_same(assemble(elements, a, 1).stiffnesses, assemble(elements, b, 1).stiffnesses, 1);
}

TEST(ElementMatrices, AreInvariantUnderRigidMotionsOfTheEmbedding) {
    const TrackedElements elements = bumpy_elements();
    const Coefficients identity = identity_coefficients(elements);
    const Coefficients displacement = wobble(elements);
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    Coefficients moved = (identity + displacement) * rotation.transpose() - identity;
    moved.rowwise() += Eigen::RowVector3d(3, -5, 2);
    expect_scaled(elements, displacement, moved, 1);
}

TEST(ElementMatrices, ScalingTheEmbeddingScalesTheMassByTheSquareAndKeepsTheStiffness) {
    const TrackedElements elements = bumpy_elements();
    const Coefficients identity = identity_coefficients(elements);
    const Coefficients displacement = wobble(elements);
    const Coefficients scaled = 3 * (identity + displacement) - identity;
    expect_scaled(elements, displacement, scaled, 9);
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
        for (std::int64_t element = 0; element < systems.matrices.size(); ++element) {
            EXPECT_EQ(to_matrix(systems.matrices, element).norm(), 0);
        }
    }
}

}  // namespace
}  // namespace tracked_mcf
