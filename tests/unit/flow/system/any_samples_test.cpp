// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow/system/element_matrices.h"
#include "tests/unit/flow/equation_4.h"

namespace tracked_mcf {
namespace {

constexpr double kStiffnessWeight = 0.75;

/// Numbers of samples around the widths of vectors and of a chunk, and zero.
constexpr std::array<int, 20> kSampleCounts = {59, 0,  1,   3,   4,   7,   8,   9,   15,   16,
                                               17, 33, 127, 128, 129, 300, 512, 900, 2500, 6};

/// Elements with random samples, normals and displacements. No two elements share unknowns.
struct RandomSurface {
    TrackedElements elements;
    std::vector<Matrix83> displacement;  ///< of each element, one row for each corner

    RandomSurface() {
        Level& level = elements.levels.emplace_back();
        elements.sample_begin = elements.fragment_begin = {0};
        for (const int count : kSampleCounts) {
            add_fragments(count);
            elements.sample_begin.push_back(elements.sample_begin.back() + count);
            elements.fragment_begin.push_back(static_cast<std::int64_t>(elements.fragments.size()));
            level.unknowns.emplace_back();
            for (int corner = 0; corner < 8; ++corner) {
                // Out of order, so that nothing can rely on an order.
                level.unknowns.back()[corner] = level.number_of_unknowns + (3 * corner + 5) % 8;
            }
            level.number_of_unknowns += 8;
            Matrix83& of_corners = displacement.emplace_back();
            for (int corner = 0; corner < 8; ++corner)
                of_corners.row(corner).setConstant(100) += vector(-0.2, 0.2).transpose();
        }
        level.cells.resize(kSampleCounts.size());
        elements.samples.resize(elements.sample_begin.back());
        for (std::int64_t sample = 0; sample < elements.samples.size(); ++sample)
            elements.samples.set(sample, vector(0, 1), uniform(0.001, 1));
    }

    /// Returns the embedding of an element in its cell: the corners' displacements and places.
    Matrix83 embedding(std::int32_t element) const {
        Matrix83 x = displacement[element];
        for (int corner = 0; corner < 8; ++corner) {
            for (int axis = 0; axis < 3; ++axis) x(corner, axis) += corner_bit(corner, axis);
        }
        return x;
    }

private:
    double uniform(double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random_);
    }
    Eigen::Vector3d vector(double from, double to) {
        return {uniform(from, to), uniform(from, to), uniform(from, to)};
    }
    void add_fragments(int samples) {
        while (samples > 0) {
            const int count = std::min(samples, static_cast<int>(uniform(0, 40)));
            const Eigen::Vector3f normal = vector(-1, 1).normalized().cast<float>();
            elements.fragments.push_back({{normal[0], normal[1], normal[2]}, count});
            samples -= count;
        }
    }

    std::mt19937 random_{6};
};

ElementSystems assemble(const RandomSurface& surface) {
    const Level& level = surface.elements.finest();
    Coefficients displacement(level.unknown_count(), 3);
    for (std::int32_t element = 0; element < level.element_count(); ++element) {
        for (int corner = 0; corner < 8; ++corner) {
            displacement.row(level.unknowns[element][corner]) =
                surface.displacement[element].row(corner);
        }
    }
    ElementSystems systems;
    assemble_elements(surface.elements, displacement, kStiffnessWeight, true, systems);
    return systems;
}

Matrix83 right_side_for(const RandomSurface& surface, std::int32_t element) {
    const Matrix83 x = surface.embedding(element);
    return -kStiffnessWeight * integrate(surface.elements, x, element).stiffness * x;
}

Matrix83 right_side_of(const ElementSystems& systems, std::int32_t element) {
    return systems.right_sides.middleCols<8>(8 * element).topRows<3>().transpose().cast<double>();
}

void check(const RandomSurface& surface) {
    const ElementSystems systems = assemble(surface);
    std::int64_t collapsed = 0;
    for (std::int32_t element = 0; element < surface.elements.finest().element_count(); ++element) {
        SCOPED_TRACE("element " + std::to_string(element));
        const Equation4 expected = integrate(surface.elements, surface.embedding(element), element);
        const Matrix8 stiffness = kStiffnessWeight * expected.stiffness;
        const Matrix8 matrix = expected.mass + stiffness;
        EXPECT_LE((whole(systems.matrices[element]) - matrix).norm(), 2e-6 * matrix.norm());
        EXPECT_LE((whole(systems.stiffnesses[element]) - stiffness).norm(),
                  2e-6 * stiffness.norm());
        EXPECT_LE((right_side_of(systems, element) - right_side_for(surface, element)).norm(),
                  2e-6 * matrix.norm());
        // With edges, the area is the difference of two sums.
        EXPECT_NEAR(systems.areas[element], expected.area, 1e-6 * expected.mass.sum());
        collapsed += expected.collapsed;
    }
    EXPECT_EQ(systems.collapsed_samples, collapsed);
}

TEST(ElementMatricesOfAnySamples, AreTheIntegralsInDouble) {
    check({});
}

TEST(ElementMatricesOfAnySamples, AreTheIntegralsInDoubleAtRest) {
    RandomSurface surface;
    for (Matrix83& displacement : surface.displacement) displacement.setConstant(-7);
    check(surface);
}

TEST(ElementMatricesOfAnySamples, ReportCollapsedSamples) {
    // Every other element is flat or a point. Samples of a flat element whose normal is in its
    // plane have nearly no area.
    RandomSurface surface;
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
    for (std::size_t f = 0; f < surface.elements.fragments.size(); f += 3) {
        Fragment& fragment = surface.elements.fragments[f];
        fragment = {{0.6F, -0.8F, 0}, fragment.sample_count};
    }
    check(surface);
}

TEST(ElementMatricesOfAnySamples, KeepTheRightHandSideAccurateWhereTheSurfaceIsCompressed) {
    // The matrix is large there, and the right-hand side is not.
    RandomSurface surface;
    for (Matrix83& displacement : surface.displacement) {
        for (int corner = 0; corner < 8; ++corner) {
            displacement.row(corner) << -0.999 * corner_bit(corner, 0), 0, 0;
        }
    }
    for (Fragment& fragment : surface.elements.fragments) {
        fragment = {{0, 0.6F, 0.8F}, fragment.sample_count};
    }
    const ElementSystems systems = assemble(surface);
    for (std::int32_t element = 0; element < surface.elements.finest().element_count(); ++element) {
        const Matrix83 expected = right_side_for(surface, element);
        EXPECT_LE((right_side_of(systems, element) - expected).norm(), 2e-6 * expected.norm());
    }
}

}  // namespace
}  // namespace tracked_mcf
