// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/kernels/integrate_elements.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

#include "filter_tracked_mcf/core/flow/system/matrix_blocks.h"
#include "tests/unit/flow/equation_4.h"
#include "tests/unit/flow/kernels/random_surface.h"

namespace tracked_mcf {
namespace {

constexpr double kStiffnessWeight = 0.75;

struct Results {
    MatrixBlocks matrices;
    MatrixBlocks stiffnesses;  ///< if they were asked for
    std::vector<ElementVector> right_sides;
    std::vector<float> areas;
    std::int64_t collapsed = 0;  ///< samples
};

Results integrate(const Surface& surface, bool keep_stiffness = false) {
    const std::vector<double> displacement = displacement_array(surface);
    const auto count = static_cast<std::size_t>(surface.element_count());
    Results results = {MatrixBlocks(surface.element_count()),
                       MatrixBlocks(keep_stiffness ? surface.element_count() : 0),
                       std::vector<ElementVector>(count), std::vector<float>(count), 0};
    IntegrationInput input = {};
    input.unknowns = surface.unknowns.data();
    input.displacement = displacement.data();
    input.samples = surface.arrays();
    input.step_size_in_squared_cells = kStiffnessWeight;
    for (; input.begin < surface.element_count(); input.begin = input.end) {
        input.end = std::min(input.begin + kElementBatch, surface.element_count());
        results.collapsed +=
            integrate_elements(input, {results.matrices.blocks(),
                                       keep_stiffness ? results.stiffnesses.blocks() : nullptr,
                                       results.right_sides.data(), results.areas.data()});
    }
    return results;
}

Equation4 equation_4_of(const Surface& surface, std::size_t element) {
    const Matrix83 x = embedding_of(surface, element);
    Equation4 equation;
    for_each_sample(surface, element,
                    [&](const Eigen::Vector3d& normal, const Eigen::Vector3d& local,
                        double weight) { equation.add_sample(normal, local, weight, x); });
    return equation;
}

Matrix83 right_side_for(const Surface& surface, std::size_t element) {
    return -kStiffnessWeight * equation_4_of(surface, element).stiffness *
           embedding_of(surface, element);
}

Matrix83 right_side_of(const Results& results, std::size_t element) {
    return Eigen::Map<const Eigen::Matrix<float, 8, 3>>(results.right_sides[element].entry[0])
        .cast<double>();
}

void expect_equation_4(const Surface& surface, const Results& results) {
    std::int64_t collapsed = 0;
    for (std::size_t element = 0; element < results.right_sides.size(); ++element) {
        SCOPED_TRACE("element " + std::to_string(element));
        const Equation4 expected = equation_4_of(surface, element);
        const Matrix8 matrix = expected.mass + kStiffnessWeight * expected.stiffness;
        const ElementMatrix whole = results.matrices.of(static_cast<std::int64_t>(element));
        const Matrix8 actual =
            Eigen::Map<const Eigen::Matrix<float, 8, 8>>(whole.entry[0]).cast<double>();
        const Matrix83 right_side = right_side_of(results, element);
        EXPECT_LE((actual - matrix).norm(), 2e-6 * matrix.norm());
        EXPECT_LE((right_side - right_side_for(surface, element)).norm(), 2e-6 * matrix.norm());
        // With edges, the area is the difference of two sums.
        EXPECT_NEAR(results.areas[element], expected.area, 1e-6 * expected.mass.sum());
        collapsed += expected.collapsed;
    }
    EXPECT_EQ(results.collapsed, collapsed);
}

void check(const Surface& surface) {
    expect_equation_4(surface, integrate(surface));
}

TEST(IntegrateElements, EqualTheIntegralsInDouble) {
    check(SurfaceMaker().make());
}

TEST(IntegrateElements, EqualTheIntegralsInDoubleAtRest) {
    Surface surface = SurfaceMaker().make();
    for (Matrix83& displacement : surface.displacement) displacement.setConstant(-7);
    check(surface);
}

TEST(IntegrateElements, ReportCollapsedSamples) {
    // Every other element is flat or a point. Samples of a flat element whose normal is in its
    // plane have nearly no area.
    Surface surface = SurfaceMaker().make();
    for (std::size_t element = 0; element < surface.displacement.size(); ++element) {
        for (int corner = 0; corner < 8; ++corner) {
            for (int axis = 0; axis < 3; ++axis) {
                const bool squeezed = element % 4 == 0 || (element % 2 == 0 && axis == 2);
                const double length = squeezed ? 0 : 1;
                surface.displacement[element](corner, axis) =
                    50 + (length - 1) * corner_bit(corner, axis);
            }
        }
    }
    for (std::size_t f = 0; f < surface.fragments.size(); f += 3) {
        surface.fragments[f] = {{0.6F, -0.8F, 0}, surface.fragments[f].sample_count};
    }
    check(surface);
}

TEST(IntegrateElements, KeepTheRightHandSideAccurateWhereTheSurfaceIsCompressed) {
    // The matrix is large there, and the right-hand side is not.
    Surface surface = SurfaceMaker().make();
    for (Matrix83& displacement : surface.displacement) {
        for (int corner = 0; corner < 8; ++corner) {
            displacement.row(corner) << -0.999 * corner_bit(corner, 0), 0, 0;
        }
    }
    for (Fragment& fragment : surface.fragments) {
        fragment = {{0, 0.6F, 0.8F}, fragment.sample_count};
    }
    const Results results = integrate(surface);
    for (std::size_t element = 0; element < results.right_sides.size(); ++element) {
        const Matrix83 expected = right_side_for(surface, element);
        EXPECT_LE((right_side_of(results, element) - expected).norm(), 2e-6 * expected.norm());
    }
}

TEST(IntegrateElements, WriteTheStiffnessesAlone) {
    const Surface surface = SurfaceMaker().make();
    const Results plain = integrate(surface);
    const Results with = integrate(surface, true);
    for (std::size_t element = 0; element < with.areas.size(); ++element) {
        const ElementMatrix whole = with.stiffnesses.of(static_cast<std::int64_t>(element));
        const Matrix8 stiffness =
            Eigen::Map<const Eigen::Matrix<float, 8, 8>>(whole.entry[0]).cast<double>();
        const Matrix8 expected = kStiffnessWeight * equation_4_of(surface, element).stiffness;
        EXPECT_LE((stiffness - expected).norm(), 2e-6 * expected.norm());
        for (int entry = 0; entry < 64; ++entry) {
            const auto index = static_cast<std::int64_t>(element);
            EXPECT_EQ(with.matrices.at(index, entry / 8, entry % 8),
                      plain.matrices.at(index, entry / 8, entry % 8));
        }
        EXPECT_EQ(right_side_of(with, element), right_side_of(plain, element));
        EXPECT_EQ(with.areas[element], plain.areas[element]);
    }
}

}  // namespace
}  // namespace tracked_mcf
