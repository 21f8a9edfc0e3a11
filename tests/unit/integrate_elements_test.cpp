#include "filter_tracked_mcf/core/kernels/integrate_elements.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "filter_tracked_mcf/core/bspline.h"
#include "filter_tracked_mcf/core/kernels/kernels.h"
#include "filter_tracked_mcf/core/matrix_blocks.h"
#include "filter_tracked_mcf/core/samples.h"

namespace tracked_mcf {
namespace {

using Matrix8 = Eigen::Matrix<double, 8, 8>;
using Matrix83 = Eigen::Matrix<double, 8, 3>;
using Vector8 = Eigen::Matrix<double, 8, 1>;

constexpr double kMassWeight = 1.5;
constexpr double kStiffnessWeight = 0.75;

/// Elements with samples anywhere, none of which share unknowns.
struct Surface {
    std::vector<Fragment> fragments;
    Samples samples;
    std::vector<std::int64_t> sample_begin;
    std::vector<std::int64_t> fragment_begin;
    std::vector<std::int32_t> unknowns;
    std::vector<Matrix83> displacement;  ///< of every element

    std::int64_t element_count() const { return static_cast<std::int64_t>(displacement.size()); }

    SampleArrays arrays() const {
        return {{samples.places(0), samples.places(1)},
                samples.weights(),
                fragments.data(),
                sample_begin.data(),
                fragment_begin.data()};
    }
};

/// Sizes around the widths of vectors and of what a kernel buffers, and none at all.
constexpr std::array<int, 20> kSampleCounts = {59, 0,  1,   3,   4,   7,   8,   9,   15,   16,
                                               17, 33, 127, 128, 129, 300, 512, 900, 2500, 6};

class SurfaceMaker {
public:
    Surface make() {
        Surface surface;
        std::int64_t samples = 0;
        for (const int count : kSampleCounts) {
            surface.sample_begin.push_back(samples);
            surface.fragment_begin.push_back(static_cast<std::int64_t>(surface.fragments.size()));
            add_fragments(count, surface);
            add_corners(surface);
            samples += count;
        }
        surface.sample_begin.push_back(samples);
        surface.fragment_begin.push_back(static_cast<std::int64_t>(surface.fragments.size()));
        surface.samples.resize(samples);
        for (std::int64_t sample = 0; sample < samples; ++sample) {
            surface.samples.set(sample, vector(0, 1), uniform(0.001, 1));
        }
        return surface;
    }

private:
    double uniform(double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random_);
    }
    Eigen::Vector3d vector(double from, double to) {
        return {uniform(from, to), uniform(from, to), uniform(from, to)};
    }

    void add_fragments(int samples, Surface& surface) {
        while (samples > 0) {
            const int count = std::min(samples, static_cast<int>(uniform(0, 40)));
            const Eigen::Vector3f normal = vector(-1, 1).normalized().cast<float>();
            surface.fragments.push_back({{normal[0], normal[1], normal[2]}, count});
            samples -= count;
        }
    }

    void add_corners(Surface& surface) {
        const auto first = static_cast<std::int32_t>(surface.unknowns.size());
        Matrix83 displacement;
        for (int corner = 0; corner < 8; ++corner) {
            // Not in order, so that nothing can rely on it.
            surface.unknowns.push_back(first + (3 * corner + 5) % 8);
            displacement.row(corner) =
                100 * Eigen::RowVector3d::Ones() + vector(-0.2, 0.2).transpose();
        }
        surface.displacement.push_back(displacement);
    }

    std::mt19937 random_{6};
};

std::vector<double> displacement_array(const Surface& surface) {
    std::vector<double> array(3 * surface.unknowns.size());
    for (std::size_t i = 0; i < surface.unknowns.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            array[3 * static_cast<std::size_t>(surface.unknowns[i]) +
                  static_cast<std::size_t>(axis)] =
                surface.displacement[i / 8](static_cast<int>(i % 8), axis);
        }
    }
    return array;
}

struct Results {
    MatrixBlocks matrices;
    std::vector<ElementVector> right_sides;
    std::vector<float> areas;
    std::vector<Collapse> collapses;
};

Results integrate(const Surface& surface, bool initial_metric, InstructionSet instructions) {
    const std::vector<double> displacement = displacement_array(surface);
    const auto count = static_cast<std::size_t>(surface.element_count());
    Results results = {MatrixBlocks(surface.element_count()),
                       std::vector<ElementVector>(count),
                       std::vector<float>(count),
                       {}};
    IntegrationInput input = {};
    input.unknowns = surface.unknowns.data();
    input.displacement = displacement.data();
    input.samples = surface.arrays();
    input.mass = kMassWeight;
    input.stiffness = kStiffnessWeight;
    input.initial_metric = initial_metric;
    for (; input.begin < surface.element_count(); input.begin = input.end) {
        input.end = std::min(input.begin + kElementBatch, surface.element_count());
        std::array<Collapse, kElementBatch> collapses;
        const int collapsed =
            kernels_for(instructions)
                .integrate_elements(
                    input,
                    {results.matrices.blocks(), results.right_sides.data(), results.areas.data()},
                    collapses.data());
        results.collapses.insert(results.collapses.end(), collapses.begin(),
                                 collapses.begin() + collapsed);
    }
    return results;
}

/// Equation 4 in double precision, from the paper's two tangents.
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
    Matrix83 x = surface.displacement[element];
    for (int corner = 0; corner < 8; ++corner) {
        for (int axis = 0; axis < 3; ++axis) x(corner, axis) += corner_bit(corner, axis);
    }
    Reference reference;
    std::int64_t sample = surface.sample_begin[element];
    for (std::int64_t f = surface.fragment_begin[element]; f < surface.fragment_begin[element + 1];
         ++f) {
        const Fragment& fragment = surface.fragments[static_cast<std::size_t>(f)];
        const Eigen::Vector3d normal =
            Eigen::Map<const Eigen::Vector3f>(fragment.normal).cast<double>();
        for (int i = 0; i < fragment.sample_count; ++i, ++sample) {
            add_sample(normal, surface.samples.local(sample), surface.samples.weight(sample), x,
                       initial_metric, reference);
        }
    }
    EXPECT_EQ(sample, surface.sample_begin[element + 1]);
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
        EXPECT_NEAR(results.areas[element], expected.area, 1e-6 * expected.area);
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

TEST_P(IntegrateElements, AreThoseOfDoublePrecision) {
    check(SurfaceMaker().make());
}

TEST_P(IntegrateElements, AtRest) {
    Surface surface = SurfaceMaker().make();
    for (Matrix83& displacement : surface.displacement) displacement.setConstant(-7);
    check(surface);
}

TEST_P(IntegrateElements, WhereSomeSamplesHaveCollapsed) {
    // Every other element is flat, so that samples whose normal lies in its plane have next to no
    // area, and some are a point.
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

TEST_P(IntegrateElements, RightSideWhereTheSurfaceIsCompressed) {
    // The matrix is large there, and the right side is not.
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
