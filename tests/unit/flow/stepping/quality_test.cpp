// SPDX-License-Identifier: GPL-3.0-or-later
// What a flow measures at each vertex.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "filter_tracked_mcf/core/errors.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

constexpr double kRadius = 3;
constexpr double kStepSize = 0.02;  ///< small beside the squared radius

FlowParameters measuring(Quality quality) {
    FlowParameters p;
    p.order = 1;
    p.depth = 5;
    p.step_size = kStepSize;
    p.iterations = 2;
    p.quality = quality;
    return p;
}

TriangleMesh sphere() {
    return shapes::transformed(shapes::geodesic_sphere(16),
                               Eigen::Affine3d(Eigen::Scaling(kRadius)));
}

std::vector<double> quality_of(TriangleMesh mesh, const FlowParameters& p,
                               const Selection& selection = {}) {
    return evolve(mesh, selection, p).quality;
}

void expect_all_near(const std::vector<double>& numbers, double expected, double tolerance) {
    ASSERT_FALSE(numbers.empty());
    const auto [least, most] = std::minmax_element(numbers.begin(), numbers.end());
    EXPECT_NEAR(*least, expected, tolerance);
    EXPECT_NEAR(*most, expected, tolerance);
}

TEST(Quality, IsEmptyUnlessAskedFor) {
    EXPECT_TRUE(quality_of(sphere(), measuring(Quality::None)).empty());
}

TEST(Quality, DoesNotChangeTheFlow) {
    const TriangleMesh plain = evolved(sphere(), measuring(Quality::None));
    for (const Quality quality : {Quality::Displacement, Quality::MeanCurvature}) {
        EXPECT_TRUE(same_bits(evolved(sphere(), measuring(quality)), plain));
    }
}

TEST(Quality, DisplacementOfASphereIsTheChangeOfItsRadius) {
    // r' = r³ / (r² + 2δ), twice
    double radius = kRadius;
    for (int step = 0; step < 2; ++step) {
        radius *= radius * radius / (radius * radius + 2 * kStepSize);
    }
    const double change = radius - kRadius;
    const FlowParameters p = measuring(Quality::Displacement);
    expect_all_near(quality_of(sphere(), p), change, 0.05 * std::abs(change));
    expect_all_near(quality_of(shapes::inside_out(sphere()), p), -change, 0.05 * std::abs(change));
}

TEST(Quality, MeanCurvatureOfASphereIsOneOverItsRadius) {
    FlowParameters p = measuring(Quality::MeanCurvature);
    expect_all_near(quality_of(sphere(), p), 1 / kRadius, 0.05 / kRadius);
    expect_all_near(quality_of(shapes::inside_out(sphere()), p), -1 / kRadius, 0.05 / kRadius);
    p.order = 3;
    expect_all_near(quality_of(sphere(), p), 1 / kRadius, 0.05 / kRadius);
}

TEST(Quality, MeanCurvatureOfABandWithoutInnerVertices) {
    FlowParameters p = measuring(Quality::MeanCurvature);
    p.boundary = BoundaryCondition::Locked;  // nothing moves
    expect_all_near(quality_of(shapes::tube(100, 1, 0.1), p), 0.5, 1e-3);
    expect_all_near(quality_of(shapes::annulus(100, 1, 0.9, 1), p), 0, 1e-6);
}

TEST(Quality, MeanCurvatureIsContinuedToVerticesFarFromTheInside) {
    // A ribbon of one quad's width, which only touches the inside with its beginning.
    TriangleMesh mesh = shapes::square(4);
    for (Eigen::Vector3d& position : mesh.positions) position *= 4;
    const auto vertex_at = [&](double x, double y) {
        const auto is_there = [&](const Eigen::Vector3d& p) {
            return (p - Eigen::Vector3d(x, y, 0)).norm() < 1e-9;
        };
        const auto found = std::find_if(mesh.positions.begin(), mesh.positions.end(), is_there);
        return static_cast<std::int32_t>(found - mesh.positions.begin());
    };
    std::int32_t low = vertex_at(4, 2), high = vertex_at(4, 3);
    for (int i = 1; i <= 20; ++i) {
        const auto next = static_cast<std::int32_t>(mesh.positions.size());
        mesh.positions.emplace_back(4 + i, 2, 0);
        mesh.positions.emplace_back(4 + i, 3, 0);
        mesh.triangles.push_back({low, next, next + 1});
        mesh.triangles.push_back({low, next + 1, high});
        low = next;
        high = next + 1;
    }
    // Bent at the seam to the ribbon only.
    for (Eigen::Vector3d& position : mesh.positions) {
        if (position.x() <= 4) position.z() = 0.1 * position.x() * position.x();
    }
    FlowParameters p = measuring(Quality::MeanCurvature);
    p.step_size = 1e-9;
    p.boundary = BoundaryCondition::Free;
    const std::vector<double> curvature = quality_of(mesh, p);
    EXPECT_LT(curvature.back(), -0.05) << "as inside";
    EXPECT_LT(curvature[mesh.positions.size() - 20], -0.05);
}

TEST(Quality, MeanCurvatureIsThatOfTheSurfaceIfItsFirstStepIsTakenBack) {
    FlowParameters p = measuring(Quality::MeanCurvature);
    p.step_size = 1000;
    for (const Preserve preserve : {Preserve::None, Preserve::Area}) {
        p.preserve = preserve;
        TriangleMesh mesh = sphere();
        const FlowReport report = evolve(mesh, p);
        EXPECT_EQ(report.stop, Stop::Vanished);
        EXPECT_TRUE(report.steps.empty());
        expect_all_near(report.quality, 1 / kRadius, 0.05 / kRadius);
    }
}

TEST(Quality, MeanCurvatureIsThatOfTheLastStepThatIsKept) {
    // In steps of 1, the radius becomes 2.45, 1.84, 1.16, 0.47 and 0.05.
    FlowParameters p = measuring(Quality::MeanCurvature);
    p.step_size = 1;
    p.iterations = 10;
    TriangleMesh mesh = sphere();
    const FlowReport stopped = evolve(mesh, p);
    ASSERT_EQ(stopped.stop, Stop::Vanished);
    ASSERT_GE(stopped.steps.size(), 2U);
    p.iterations = static_cast<int>(stopped.steps.size());
    EXPECT_EQ(stopped.quality, quality_of(sphere(), p));
}

TEST(Quality, MeanCurvatureDoesNotSeeWhatIsPreserved) {
    for (const Preserve preserve : {Preserve::Area, Preserve::Volume}) {
        FlowParameters p = measuring(Quality::MeanCurvature);
        p.boundary = BoundaryCondition::Free;
        p.preserve = preserve;
        p.iterations = 4;
        expect_all_near(quality_of(sphere(), p), 1 / kRadius, 0.05 / kRadius);
    }
}

TEST(Quality, MeanCurvatureIsAccurateEverywhere) {
    // Also at the vertices of a regular sphere that have five triangles, on the boundary, and in
    // the ring beside it, whether the boundary is locked or not.
    const TriangleMesh whole = shapes::geodesic_sphere(30);
    for (const TriangleMesh& mesh : {whole, part_of(whole, above(whole, 0.1))}) {
        for (const auto boundary : {BoundaryCondition::Locked, BoundaryCondition::Free}) {
            FlowParameters p = measuring(Quality::MeanCurvature);
            p.boundary = boundary;
            p.step_size = 1e-9;
            const std::vector<double> quality = quality_of(mesh, p);
            for (const Triangle& triangle : mesh.triangles) {
                for (const std::int32_t vertex : triangle) EXPECT_NEAR(quality[vertex], 1, 0.02);
            }
        }
    }
}

TEST(Quality, OfATriangleSoupIsThatOfTheMesh) {
    const TriangleMesh mesh = shapes::bumpy_sphere(8);
    for (const Quality quality : {Quality::Displacement, Quality::MeanCurvature}) {
        const auto of_mesh = quality_of(mesh, measuring(quality));
        const auto of_soup = quality_of(shapes::soup(mesh), measuring(quality));
        for (std::size_t i = 0; i < of_soup.size(); ++i) {
            EXPECT_NEAR(of_soup[i], of_mesh[mesh.triangles[i / 3][i % 3]], 1e-6);
        }
    }
}

TEST(Quality, IsZeroWhereNothingFlows) {
    // Half of the faces are selected; one vertex is used by none, and is not a number.
    TriangleMesh mesh = sphere();
    mesh.positions.emplace_back(
        Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()));
    Selection selection;
    for (const Triangle& triangle : mesh.triangles) {
        selection.push_back(mesh.positions[triangle[0]].z() > 0 ? 1 : 0);
    }
    std::vector<bool> flows(mesh.positions.size(), false), stays(mesh.positions.size(), false);
    for (std::size_t i = 0; i < selection.size(); ++i) {
        for (const std::int32_t vertex : mesh.triangles[i]) {
            (selection[i] != 0 ? flows : stays)[vertex] = true;
        }
    }
    const auto moved = quality_of(mesh, measuring(Quality::Displacement), selection);
    const auto curvature = quality_of(mesh, measuring(Quality::MeanCurvature), selection);
    ASSERT_EQ(moved.size(), mesh.positions.size());
    ASSERT_EQ(curvature.size(), mesh.positions.size());
    for (std::size_t i = 0; i < moved.size(); ++i) {
        EXPECT_EQ(moved[i] != 0, flows[i] && !stays[i]);
        EXPECT_EQ(curvature[i] != 0, flows[i]);
    }
}

TEST(Quality, MeanCurvatureIsMeasuredAfterAnyFlow) {
    FlowParameters p = measuring(Quality::MeanCurvature);
    p.step_size = 1e-9;
    for (const FlowKind flow : {FlowKind::MeanCurvature, FlowKind::Conformalized}) {
        p.flow = flow;
        expect_all_near(quality_of(sphere(), p), 1 / kRadius, 0.02 / kRadius);
    }
    p.flow = FlowKind::MeanCurvature;
    p.method = Method::Paper;
    expect_all_near(quality_of(sphere(), p), 1 / kRadius, 0.02 / kRadius);
}

}  // namespace
}  // namespace tracked_mcf
