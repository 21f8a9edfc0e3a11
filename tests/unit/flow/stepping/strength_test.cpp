// SPDX-License-Identifier: GPL-3.0-or-later
// A strength at each vertex, which multiplies the detail size.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/evolve.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_distance.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

struct WeightedMesh : TriangleMesh {
    std::vector<double> strength;
};

FlowReport evolve(WeightedMesh& mesh, const FlowParameters& p, const Selection& selection = {}) {
    return tracked_mcf::evolve(mesh, {selection, mesh.strength}, p);
}

/// Returns a sphere with noise whose vertices have the strength `of` their height, -1 to 1.
template <class Of>
WeightedMesh noisy_sphere(const Of& of) {
    WeightedMesh mesh{shapes::bumpy_sphere(20), {}};
    for (const Eigen::Vector3d& p : mesh.positions) mesh.strength.push_back(of(p.normalized()[2]));
    return mesh;
}

TEST(Strength, OneEverywhereChangesNothing) {
    FlowParameters p = parameters(5, 1e-3, 2);
    p.order = 2;
    WeightedMesh mesh = noisy_sphere([](double) { return 1.0; });
    EXPECT_EQ(evolve(mesh, p).zero_strength_triangles, 0);
    EXPECT_TRUE(same_bits(mesh, evolved(shapes::bumpy_sphere(20), p)));
}

TEST(Strength, MultipliesTheDetailSize) {
    const TriangleMesh initial = shapes::bumpy_sphere(20);
    for (const double strength : {0.2, 0.5, 0.7}) {
        WeightedMesh weaker = noisy_sphere([&](double) { return strength; });
        FlowParameters p = parameters(5, 1e-3, 2);
        p.tolerance = 1e-6;
        evolve(weaker, p);
        // The detail size is proportional to the square root of δ.
        p.step_size *= strength * strength;
        const TriangleMesh expected = evolved(initial, p);
        EXPECT_LT(rms_distance(weaker, expected), 1e-5 * rms_distance(initial, expected))
            << strength;
    }
}

TEST(Strength, GoesDownToAThousandth) {
    FlowParameters p = parameters(5, 1e-3, 1);
    const auto moved = [&](double strength) {
        WeightedMesh mesh = noisy_sphere([&](double) { return strength; });
        return evolve(mesh, p).rms_displacement;
    };
    EXPECT_EQ(moved(1e-9), moved(1e-3));
    for (const double strength : {1.0, 0.1, 0.01}) {
        EXPECT_LT(moved(0.1 * strength), 0.1 * moved(strength));
    }
}

TEST(Strength, ZeroHoldsAndTheSurfaceStaysWhole) {
    for (const Preserve preserve : {Preserve::None, Preserve::Volume}) {
        FlowParameters p = parameters(5, 1e-3, 3);
        p.preserve = preserve;
        const WeightedMesh before = noisy_sphere([](double z) { return z > 0 ? 0.0 : 1.0; });
        WeightedMesh mesh = before;
        const FlowReport report = evolve(mesh, p);
        EXPECT_GT(report.zero_strength_triangles, 3000);
        EXPECT_EQ(report.unselected_triangles, 0);
        EXPECT_EQ(report.triangles + report.zero_strength_triangles, 8000);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            EXPECT_EQ(mesh.positions[i] == before.positions[i], before.strength[i] == 0) << i;
        }
    }
}

TEST(Strength, FadesOutAtASoftMask) {
    // The movement follows the squared strength, up to the detail size.
    const auto fading = [](double z) { return std::clamp(0.5 - 2 * z, 0.0, 1.0); };
    const WeightedMesh before = noisy_sphere(fading);
    WeightedMesh mesh = before;
    evolve(mesh, parameters(5, 1e-4, 1));
    double strongest = 0, weak = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const double moved = (mesh.positions[i] - before.positions[i]).norm();
        double& largest = before.strength[i] == 1 ? strongest : weak;
        if (before.strength[i] == 1 || before.strength[i] < 0.3) largest = std::max(largest, moved);
    }
    EXPECT_GT(weak, 0);
    EXPECT_LT(weak, 0.3 * strongest);
}

TEST(Strength, ChangesFromVertexToVertexAsItLikes) {
    WeightedMesh cap{shapes::bumpy_sphere(20), {}};
    cap.triangles.resize(cap.triangles.size() / 2);
    for (std::size_t i = 0; i < cap.positions.size(); ++i) {
        cap.strength.push_back(static_cast<double>(i % 5) / 4);
    }
    for (const int depth : {3, 4, 5, 6}) {
        WeightedMesh mesh = cap;
        const FlowReport report = evolve(mesh, parameters(depth, 1e-3, 5));
        EXPECT_EQ(report.steps.size(), 5U) << depth;
        for (const StepReport& step : report.steps) EXPECT_TRUE(step.reached_tolerance) << depth;
    }
}

TEST(Strength, ASingleVertexWithZeroStays) {
    WeightedMesh mesh = noisy_sphere([](double) { return 1.0; });
    mesh.strength[7] = 0;
    const TriangleMesh before = mesh;
    const FlowReport report = evolve(mesh, parameters(5, 1e-3, 2));
    EXPECT_EQ(report.zero_strength_triangles, 0);
    EXPECT_EQ(report.held_vertices, 1);
    EXPECT_EQ(mesh.positions[7], before.positions[7]);
    EXPECT_NE(mesh.positions[8], before.positions[8]);
}

TEST(Strength, CoincidentVerticesTakeThatOfTheFirst) {
    WeightedMesh welded = noisy_sphere([](double z) { return z > 0 ? 0.0 : 1.0; });
    WeightedMesh soup{shapes::soup(welded), {}};
    std::vector<bool> seen(welded.positions.size(), false);
    for (std::size_t i = 0; i < soup.positions.size(); ++i) {
        const std::int32_t vertex = welded.triangles[i / 3][i % 3];
        const double strength = welded.strength[vertex];
        soup.strength.push_back(seen[vertex] ? 1 - strength : strength);
        seen[vertex] = true;
    }
    const FlowReport report = evolve(soup, parameters(5, 1e-3, 2));
    EXPECT_EQ(report.zero_strength_triangles,
              evolve(welded, parameters(5, 1e-3, 2)).zero_strength_triangles);
    for (std::size_t i = 0; i < soup.positions.size(); ++i) {
        const std::int32_t vertex = welded.triangles[i / 3][i % 3];
        ASSERT_LT((soup.positions[i] - welded.positions[vertex]).norm(), 1e-6) << i;
    }
}

TEST(Strength, CountsOnlySelectedFacesAsHeld) {
    WeightedMesh mesh = noisy_sphere([](double z) { return z > 0.5 ? 0.0 : 1.0; });
    Selection upper(mesh.triangles.size());
    for (std::size_t i = 0; i < upper.size(); ++i) {
        upper[i] = mesh.positions[mesh.triangles[i][0]][2] > 0 ? 1 : 0;
    }
    const auto selected = std::count(upper.begin(), upper.end(), 1);
    const FlowReport report = evolve(mesh, parameters(5, 1e-3, 1), upper);
    EXPECT_GT(report.zero_strength_triangles, 1000);
    EXPECT_EQ(report.triangles + report.zero_strength_triangles, selected);
    EXPECT_EQ(report.unselected_triangles, 8000 - selected);
}

TEST(Strength, RefusesNumbersOutsideItsRangeAndLeavesTheMeshAsItWas) {
    const auto refused = [](const std::vector<double>& strength) -> std::string {
        WeightedMesh mesh{shapes::bumpy_sphere(5), {}};
        mesh.strength.assign(mesh.positions.size(), 1);
        for (std::size_t i = 0; i < strength.size(); ++i) mesh.strength[i] = strength[i];
        if (strength.empty()) mesh.strength.pop_back();
        const TriangleMesh before = mesh;
        try {
            evolve(mesh, parameters(3, 1e-3, 1));
        } catch (const Error& error) {
            EXPECT_TRUE(same_bits(mesh, before));
            return error.what();
        }
        return "nothing";
    };
    EXPECT_EQ(refused({1, 1, 1.5}), "The strength of vertex 2 is 1.5; give numbers from 0 to 1.");
    EXPECT_NE(refused({-1e-9}), "nothing");
    EXPECT_NE(refused({std::numeric_limits<double>::quiet_NaN()}), "nothing");
    EXPECT_EQ(refused({}), "There are 251 strengths for the 252 vertices; give one for each.");
    EXPECT_EQ(refused(std::vector<double>(252, 0)),
              "Nothing can move: all vertices of the faces to smooth have strength 0. Give some a "
              "larger one.");
    EXPECT_EQ(refused({0, 0, 0}), "nothing");
}

}  // namespace
}  // namespace tracked_mcf
