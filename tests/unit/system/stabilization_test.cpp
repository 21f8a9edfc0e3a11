// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/system/stabilization.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "filter_tracked_mcf/core/cells/bspline.h"
#include "tests/support/bspline_gradients.h"
#include "tests/support/elements.h"
#include "tests/support/shapes.h"
#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

using CornerMatrix = Eigen::Matrix<double, 8, 8>;

/// Returns the matrices that the stabilisation adds.
MatrixBlocks stabilization(const TrackedElements& elements, double weight, double step_size) {
    MatrixBlocks matrices(elements.finest().element_count());
    std::fill_n(matrices.blocks(), matrices.block_count(), MatrixBlock{});
    Stabilization(elements).add(weight, step_size, matrices);
    return matrices;
}

TrackedElements elements_of(const TriangleMesh& mesh, int depth) {
    return build_tracked_elements(mesh, enclosing_grid(mesh, depth), Cubature::ThreePoints);
}

CornerMatrix matrix(const MatrixBlocks& matrices, std::int64_t element) {
    const ElementMatrix whole = matrices.of(element);
    return Eigen::Map<const Eigen::Matrix<float, 8, 8>>(whole.entry[0]).cast<double>();
}

double area_of(const TrackedElements& elements, std::int32_t element) {
    double area = 0;
    for (auto i = elements.sample_begin[element]; i < elements.sample_begin[element + 1]; ++i) {
        area += elements.samples.weight(i);
    }
    return area;
}

/// Returns ∫_cell (n·∇B_I)(n·∇B_J) dV by the two-point Gauss rule on each axis, exact to degree 3.
CornerMatrix integrated(const Eigen::Vector3d& normal) {
    CornerMatrix sum = CornerMatrix::Zero();
    const double offset = 0.5 / std::sqrt(3.0);
    for (int point = 0; point < 8; ++point) {
        Eigen::Vector3d local;
        for (int axis = 0; axis < 3; ++axis) {
            local[axis] = 0.5 + (corner_bit(point, axis) != 0 ? offset : -offset);
        }
        const Eigen::Matrix<double, 8, 1> slope = bspline_gradients(local) * normal;
        sum += slope * slope.transpose() / 8;
    }
    return sum;
}

Eigen::Affine3d some_rotation() {
    return Eigen::Affine3d(Eigen::AngleAxisd(0.7, Eigen::Vector3d(0.3, -0.5, 0.8).normalized()));
}

TEST(Stabilization, OfAFlatElementIsTheIntegralOverItsCellTimesItsArea) {
    const Eigen::Affine3d rotation = some_rotation();
    const TrackedElements elements =
        elements_of(shapes::transformed(shapes::square(10), rotation), 3);
    const CornerMatrix expected = integrated(rotation.linear() * Eigen::Vector3d::UnitZ());
    const double weight = 0.02, step_size = 0.7;
    const auto matrices = stabilization(elements, weight, step_size);
    for (std::int32_t element = 0; element < elements.finest().element_count(); ++element) {
        const double factor = weight * (step_size + 0.1) * area_of(elements, element);
        EXPECT_LT((matrix(matrices, element) - factor * expected).norm(),
                  1e-5 * factor * expected.norm());
    }
}

TEST(Stabilization, AnnihilatesFunctionsConstantAlongTheNormal) {
    const Eigen::Affine3d rotation = some_rotation();
    const TrackedElements elements =
        elements_of(shapes::transformed(shapes::square(10), rotation), 3);
    const auto matrices = stabilization(elements, 1, 1);
    const Eigen::Vector3d tangent = rotation.linear() * Eigen::Vector3d::UnitX();
    Eigen::Matrix<double, 8, 1> linear;
    for (int corner = 0; corner < 8; ++corner) {
        linear[corner] =
            Eigen::Vector3d(corner_bit(corner, 0), corner_bit(corner, 1), corner_bit(corner, 2))
                .dot(tangent);
    }
    for (std::int64_t element = 0; element < matrices.size(); ++element) {
        EXPECT_LT((matrix(matrices, element) * linear).norm(),
                  1e-5 * matrix(matrices, element).norm());
    }
}

TEST(Stabilization, DoesNotDependOnTheOrientationOfFaces) {
    const TriangleMesh mesh = shapes::bumpy_sphere(12);
    TriangleMesh mixed = mesh;
    for (std::size_t t = 0; t < mixed.triangles.size(); t += 3) {
        std::swap(mixed.triangles[t][1], mixed.triangles[t][2]);
    }
    const auto expected = stabilization(elements_of(mesh, 4), 1, 1);
    const auto matrices = stabilization(elements_of(mixed, 4), 1, 1);
    ASSERT_EQ(matrices.size(), expected.size());
    for (std::int64_t i = 0; i < matrices.size(); ++i) {
        EXPECT_LT((matrix(matrices, i) - matrix(expected, i)).norm(),
                  1e-5 * matrix(expected, i).norm() + 1e-7);
    }
}

TEST(Stabilization, FadesWhereNormalsDisagree) {
    // The cell at a box's corner has three orthogonal normals of equal weight. A cell on a side has
    // one normal.
    const TrackedElements elements = elements_of(shapes::box(8, {1, 1, 1}), 2);
    const auto matrices = stabilization(elements, 1, 1);
    double smallest = 1e9, largest = 0;
    for (std::int32_t element = 0; element < elements.finest().element_count(); ++element) {
        const double strength = matrix(matrices, element).norm() / area_of(elements, element);
        smallest = std::min(smallest, strength);
        largest = std::max(largest, strength);
    }
    EXPECT_NEAR(largest, 1.1 * integrated(Eigen::Vector3d::UnitX()).norm(), 1e-5);
    EXPECT_LT(smallest, 1e-5 * largest);
}

TEST(Stabilization, AddsNothingForWeightZero) {
    const TrackedElements elements = elements_of(shapes::bumpy_sphere(6), 3);
    const auto matrices = stabilization(elements, 0, 1);
    for (std::int64_t element = 0; element < matrices.size(); ++element) {
        EXPECT_TRUE(matrix(matrices, element).isZero(0));
    }
}

}  // namespace
}  // namespace tracked_mcf
