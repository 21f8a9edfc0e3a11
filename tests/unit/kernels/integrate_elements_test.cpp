// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/kernels/integrate_elements.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <string>
#include <tuple>
#include <vector>

#include "filter_tracked_mcf/core/cells/bspline.h"
#include "filter_tracked_mcf/core/kernels/kernels.h"
#include "filter_tracked_mcf/core/system/matrix_blocks.h"
#include "tests/support/bspline_gradients.h"
#include "tests/unit/kernels/random_surface.h"

namespace tracked_mcf {
namespace {

using Matrix8 = Eigen::Matrix<double, 8, 8>;
using Vector8 = Eigen::Matrix<double, 8, 1>;

constexpr double kMassWeight = 1.5;
constexpr double kStiffnessWeight = 0.75;

struct Results {
    MatrixBlocks matrices;
    MatrixBlocks stiffnesses;  ///< if they were asked for
    std::vector<ElementVector> right_sides;
    std::vector<float> areas;
    std::vector<Collapse> collapses;
};

struct Wanted {
    float mass = kMassWeight;
    bool stiffnesses = false;
};

Results integrate(const Surface& surface, bool initial_metric, InstructionSet instructions,
                  Wanted wanted = {}) {
    const std::vector<double> displacement = displacement_array(surface);
    const auto count = static_cast<std::size_t>(surface.element_count());
    Results results = {MatrixBlocks(surface.element_count()),
                       MatrixBlocks(wanted.stiffnesses ? surface.element_count() : 0),
                       std::vector<ElementVector>(count),
                       std::vector<float>(count),
                       {}};
    IntegrationInput input = {};
    input.unknowns = surface.unknowns.data();
    input.displacement = displacement.data();
    input.samples = surface.arrays();
    input.mass = wanted.mass;
    input.step_size_in_cells = kStiffnessWeight;
    input.initial_metric = initial_metric;
    for (; input.begin < surface.element_count(); input.begin = input.end) {
        input.end = std::min(input.begin + kElementBatch, surface.element_count());
        std::array<Collapse, kElementBatch> collapses;
        const int collapsed =
            kernels_for(instructions)
                .integrate_elements(input,
                                    {results.matrices.blocks(),
                                     wanted.stiffnesses ? results.stiffnesses.blocks() : nullptr,
                                     results.right_sides.data(), results.areas.data()},
                                    collapses.data());
        results.collapses.insert(results.collapses.end(), collapses.begin(),
                                 collapses.begin() + collapsed);
    }
    return results;
}

/// Equation 4 in double with the paper's two tangents.
struct Reference {
    Matrix8 mass = Matrix8::Zero();
    Matrix8 stiffness = Matrix8::Zero();
    Matrix83 right_side = Matrix83::Zero();
    double area = 0;
    int collapsed = 0;
    Vector8 collapsed_mass = Vector8::Zero();
};

void add_sample(const Eigen::Vector3d& normal, const Eigen::Vector3d& local, double weight,
                const Matrix83& x, bool initial_metric, Reference& reference) {
    Eigen::Matrix<double, 3, 2> tangents;
    tangents.col(0) = normal.unitOrthogonal();
    tangents.col(1) = normal.cross(tangents.col(0));
    const Vector8 values = bspline_values(local);
    const Eigen::Matrix<double, 8, 2> slopes = bspline_gradients(local) * tangents;
    const Eigen::Matrix<double, 3, 2> dx = x.transpose() * slopes;
    const Eigen::Matrix2d g = dx.transpose() * dx;
    const double area = dx.col(0).cross(dx.col(1)).norm();
    if (!initial_metric && area <= 1e-4) {
        ++reference.collapsed;
        reference.collapsed_mass += weight * values.cwiseAbs2();
        return;
    }
    const Eigen::Matrix2d metric =
        initial_metric ? Eigen::Matrix2d::Identity() : Eigen::Matrix2d(area * g.inverse());
    const Matrix8 stiffness = weight * slopes * metric * slopes.transpose();
    reference.mass += area * weight * values * values.transpose();
    reference.stiffness += stiffness;
    reference.right_side -= kStiffnessWeight * stiffness * x;
    reference.area += area * weight;
}

Reference reference_for(const Surface& surface, std::size_t element, bool initial_metric) {
    const Matrix83 x = embedding_of(surface, element);
    Reference reference;
    for_each_sample(
        surface, element,
        [&](const Eigen::Vector3d& normal, const Eigen::Vector3d& local, double weight) {
            add_sample(normal, local, weight, x, initial_metric, reference);
        });
    return reference;
}

Matrix83 right_side_of(const Results& results, std::size_t element) {
    return Eigen::Map<const Eigen::Matrix<float, 8, 3>>(results.right_sides[element].entry[0])
        .cast<double>();
}

void expect_reference(const Surface& surface, const Results& results, bool initial_metric) {
    std::size_t next_collapse = 0;
    for (std::size_t element = 0; element < results.right_sides.size(); ++element) {
        SCOPED_TRACE("element " + std::to_string(element));
        const Reference expected = reference_for(surface, element, initial_metric);
        const Matrix8 matrix = kMassWeight * expected.mass + kStiffnessWeight * expected.stiffness;
        const ElementMatrix whole = results.matrices.of(static_cast<std::int64_t>(element));
        const Matrix8 actual =
            Eigen::Map<const Eigen::Matrix<float, 8, 8>>(whole.entry[0]).cast<double>();
        const Matrix83 right_side = right_side_of(results, element);
        EXPECT_LE((actual - matrix).norm(), 2e-6 * matrix.norm());
        EXPECT_LE((right_side - expected.right_side).norm(), 2e-6 * matrix.norm());
        // With edges, the area is the difference of two sums.
        EXPECT_NEAR(results.areas[element], expected.area, 1e-6 * expected.mass.sum());
        if (expected.collapsed == 0) continue;
        ASSERT_LT(next_collapse, results.collapses.size());
        const Collapse& collapse = results.collapses[next_collapse++];
        EXPECT_EQ(collapse.element, static_cast<std::int32_t>(element));
        EXPECT_EQ(collapse.samples, expected.collapsed);
        const Vector8 mass =
            Eigen::Map<const Eigen::Matrix<float, 8, 1>>(collapse.mass).cast<double>();
        EXPECT_LE((mass - expected.collapsed_mass).norm(), 1e-6 * expected.collapsed_mass.norm());
    }
    EXPECT_EQ(next_collapse, results.collapses.size());
}

class IntegrateElements : public testing::TestWithParam<std::tuple<InstructionSet, bool>> {
protected:
    void check(const Surface& surface) {
        const auto [instructions, initial_metric] = GetParam();
        expect_reference(surface, integrate(surface, initial_metric, instructions), initial_metric);
    }
};

TEST_P(IntegrateElements, EqualTheIntegralsInDouble) {
    check(SurfaceMaker().make());
}

TEST_P(IntegrateElements, EqualTheIntegralsInDoubleAtRest) {
    Surface surface = SurfaceMaker().make();
    for (Matrix83& displacement : surface.displacement) displacement.setConstant(-7);
    check(surface);
}

TEST_P(IntegrateElements, ReportCollapsedSamples) {
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

TEST_P(IntegrateElements, KeepTheRightHandSideAccurateWhereTheSurfaceIsCompressed) {
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
    const auto [instructions, initial_metric] = GetParam();
    const Results results = integrate(surface, initial_metric, instructions);
    for (std::size_t element = 0; element < results.right_sides.size(); ++element) {
        const Matrix83 expected = reference_for(surface, element, initial_metric).right_side;
        EXPECT_LE((right_side_of(results, element) - expected).norm(), 2e-6 * expected.norm());
    }
}

TEST_P(IntegrateElements, WriteTheStiffnessesAloneWithTheBitsOfNoMass) {
    // 0 times the mass adds nothing, so both sums have the same single rounding.
    const Surface surface = SurfaceMaker().make();
    const auto [instructions, initial_metric] = GetParam();
    const Results plain = integrate(surface, initial_metric, instructions);
    const Results with = integrate(surface, initial_metric, instructions, {kMassWeight, true});
    const Results massless = integrate(surface, initial_metric, instructions, {0, false});
    for (std::int64_t element = 0; element < surface.element_count(); ++element) {
        for (int row = 0; row < 8; ++row) {
            for (int column = 0; column < 8; ++column) {
                EXPECT_EQ(with.stiffnesses.at(element, row, column),
                          massless.matrices.at(element, row, column));
                EXPECT_EQ(with.matrices.at(element, row, column),
                          plain.matrices.at(element, row, column));
            }
        }
        const auto index = static_cast<std::size_t>(element);
        EXPECT_EQ(right_side_of(with, index), right_side_of(plain, index));
        EXPECT_EQ(with.areas[index], plain.areas[index]);
    }
}

TEST(InstructionSetsOfFourLanes, GiveTheSameBits) {
    const std::vector<InstructionSet> available = available_instruction_sets();
    if (std::count(available.begin(), available.end(), InstructionSet::Ssse3) == 0) {
        GTEST_SKIP() << "This machine has one alone.";
    }
    const Surface surface = SurfaceMaker().make();
    for (const bool initial_metric : {false, true}) {
        const Results a = integrate(surface, initial_metric, InstructionSet::Baseline);
        const Results b = integrate(surface, initial_metric, InstructionSet::Ssse3);
        EXPECT_EQ(a.areas, b.areas);
        for (std::size_t element = 0; element < a.areas.size(); ++element) {
            EXPECT_EQ(right_side_of(a, element), right_side_of(b, element));
            for (int entry = 0; entry < 64; ++entry) {
                const auto index = static_cast<std::int64_t>(element);
                EXPECT_EQ(a.matrices.at(index, entry / 8, entry % 8),
                          b.matrices.at(index, entry / 8, entry % 8));
            }
        }
    }
}

std::string name_of_case(const testing::TestParamInfo<std::tuple<InstructionSet, bool>>& info) {
    return std::string(name_of(std::get<0>(info.param))) +
           (std::get<1>(info.param) ? "_InitialMetric" : "_PresentMetric");
}

INSTANTIATE_TEST_SUITE_P(InstructionSets, IntegrateElements,
                         testing::Combine(testing::ValuesIn(available_instruction_sets()),
                                          testing::Bool()),
                         name_of_case);

}  // namespace
}  // namespace tracked_mcf
