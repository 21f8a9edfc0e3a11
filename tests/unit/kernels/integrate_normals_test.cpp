// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/kernels/integrate_normals.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/cells/bspline.h"
#include "filter_tracked_mcf/core/kernels/kernels.h"
#include "filter_tracked_mcf/core/system/element_matrices.h"
#include "tests/support/bspline_gradients.h"
#include "tests/support/elements.h"
#include "tests/support/shapes.h"
#include "tests/unit/kernels/random_surface.h"

namespace tracked_mcf {
namespace {

Matrix83 to_matrix(const ElementVector& vector) {
    return Eigen::Map<const Eigen::Matrix<float, 8, 3>>(vector.entry[0]).cast<double>();
}

/// ∫ B_I n in double: the cross product of two tangents' images is the normal times the area.
struct NormalsReference {
    Matrix83 normals = Matrix83::Zero();
    double size = 0;  ///< the same sum with the absolute values of its terms
};

NormalsReference reference_for(const Surface& surface, std::size_t element) {
    const Matrix83 x = embedding_of(surface, element);
    NormalsReference reference;
    for_each_sample(
        surface, element,
        [&](const Eigen::Vector3d& normal, const Eigen::Vector3d& local, double weight) {
            const Eigen::Vector3d tangent = normal.unitOrthogonal();
            const Eigen::Matrix3d dx = x.transpose() * bspline_gradients(local);
            const Eigen::Vector3d force = weight * (dx * tangent).cross(dx * normal.cross(tangent));
            reference.normals += bspline_values(local) * force.transpose();
            reference.size += force.norm();
        });
    return reference;
}

std::vector<ElementVector> integrate(const Surface& surface, InstructionSet instructions) {
    const std::vector<double> displacement = displacement_array(surface);
    std::vector<ElementVector> normals(static_cast<std::size_t>(surface.element_count()));
    IntegrationInput input = {};
    input.unknowns = surface.unknowns.data();
    input.displacement = displacement.data();
    input.samples = surface.arrays();
    for (; input.begin < surface.element_count(); input.begin = input.end) {
        input.end = std::min(input.begin + kElementBatch, surface.element_count());
        kernels_for(instructions).integrate_normals(input, normals.data());
    }
    return normals;
}

class IntegrateNormals : public testing::TestWithParam<InstructionSet> {};

TEST_P(IntegrateNormals, EqualTheIntegralsInDouble) {
    Surface surface = SurfaceMaker().make();
    for (const bool at_rest : {false, true}) {
        if (at_rest) {
            for (Matrix83& displacement : surface.displacement) displacement.setConstant(-7);
        }
        const std::vector<ElementVector> normals = integrate(surface, GetParam());
        for (std::size_t element = 0; element < normals.size(); ++element) {
            SCOPED_TRACE("element " + std::to_string(element));
            // The kernel rounds each term to single precision. The tolerance is that of the right
            // sides in integrate_elements_test.cpp, 17 roundings.
            const NormalsReference expected = reference_for(surface, element);
            EXPECT_LE((to_matrix(normals[element]) - expected.normals).norm(),
                      1e-6 * expected.size);
        }
    }
}

TEST_P(IntegrateNormals, HaveTheSideOfTheTrianglesOwn) {
    // One sample in the middle of a cell at rest: every function is 1/8.
    Surface surface;
    surface.fragments = {{{0, 0.6F, 0.8F}, 1}};
    surface.samples.resize(1);
    surface.samples.set(0, Eigen::Vector3d::Constant(0.5), 2);
    surface.sample_begin = {0, 1};
    surface.fragment_begin = {0, 1};
    surface.unknowns = {0, 1, 2, 3, 4, 5, 6, 7};
    surface.displacement = {Matrix83::Zero()};
    const Matrix83 normals = to_matrix(integrate(surface, GetParam()).front());
    for (int corner = 0; corner < 8; ++corner) {
        EXPECT_LT((normals.row(corner) - Eigen::RowVector3d(0, 0.15, 0.2)).norm(), 1e-6);
    }
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, IntegrateNormals,
                         testing::ValuesIn(available_instruction_sets()),
                         [](const auto& instance) { return std::string(name_of(instance.param)); });

TEST(IntegratedNormals, SatisfyTheDivergenceTheorem) {
    // ∫ n = 0 and ∫ x·n = 3 V for a closed surface, here stretched by its displacement. The
    // quadrature is exact to degree 2 for x·n and rounds in single precision.
    const TriangleMesh mesh = shapes::bumpy_sphere(12);
    const TrackedElements elements =
        build_tracked_elements(mesh, enclosing_grid(mesh, 4), Cubature::ThreePoints);
    const Eigen::RowVector3d stretch(1, 2, 0.5);
    const Coefficients x = identity_coefficients(elements) * stretch.asDiagonal();
    std::vector<ElementVector> normals;
    assemble_normals(elements, x - identity_coefficients(elements), normals);
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    double flux = 0;
    for (std::size_t element = 0; element < normals.size(); ++element) {
        const Matrix83 normal = to_matrix(normals[element]);
        for (int corner = 0; corner < 8; ++corner) {
            sum += normal.row(corner);
            flux += normal.row(corner).dot(x.row(elements.finest().unknowns[element][corner]));
        }
    }
    const double cell = elements.grid.cell_size;
    const double expected = 3 * stretch.prod() * enclosed_volume(mesh) / (cell * cell * cell);
    // Single precision relative to the largest terms: 16 cells from the cube's corner.
    EXPECT_NEAR(flux, expected, 1e-4 * expected);
    EXPECT_LT(sum.norm(), 1e-4 * expected / 16);
}

}  // namespace
}  // namespace tracked_mcf
