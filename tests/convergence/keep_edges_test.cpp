// SPDX-License-Identifier: GPL-3.0-or-later
// Flows that keep edges (FlowParameters::keep_edges): exact answers, and what becomes of an edge.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "filter_tracked_mcf/core/evolve.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

constexpr double kStepSize = 0.05;

/// Makes one step that keeps edges. Returns s², the square of the length that weighs the normals.
double one_step(TriangleMesh& mesh, double angle) {
    FlowParameters parameters;
    parameters.keep_edges = angle;
    parameters.step_size = kStepSize;
    parameters.absolute = true;
    parameters.iterations = 1;
    parameters.boundary = BoundaryCondition::Free;
    const double s = evolve(mesh, parameters).normal_length;
    return s * s;
}

// Where all normals turn with a radius of 1, all lengths that count are √(1 + s²) times as long. So
// a step multiplies by 1 / (1 + κ δ / (1 + s²)), with κ = 2 for a sphere.
TEST(KeepEdges, ASphereFlowsMoreSlowly) {
    for (const double angle : {20.0, 60.0, 179.0}) {
        TriangleMesh sphere = shapes::geodesic_sphere(48);
        const double squared = one_step(sphere, angle);
        const double expected = 1 / (1 + 2 * kStepSize / (1 + squared));
        std::printf("%g degrees, s² %.3g: radius %.5f, exact %.5f\n", angle, squared,
                    sphere.positions[0].norm(), expected);
        for (const Eigen::Vector3d& p : sphere.positions) {
            EXPECT_NEAR(p.norm(), expected, 0.02 * (1 - expected));
        }
    }
}

TEST(KeepEdges, ACylinderFlowsMoreSlowlyFarFromItsEnds) {
    for (const double angle : {20.0, 60.0, 179.0}) {
        TriangleMesh tube = shapes::tube(192, 192, 8);
        const double squared = one_step(tube, angle);
        const double expected = 1 / (1 + kStepSize / (1 + squared));
        std::printf("%g degrees, s² %.3g: exact %.5f\n", angle, squared, expected);
        for (const Eigen::Vector3d& p : tube.positions) {
            if (std::abs(p.z()) > 1) continue;
            EXPECT_NEAR(std::hypot(p.x(), p.y()), expected, 0.03 * (1 - expected));
        }
    }
}

// The mesh's edges, the grid's cells and the errors of the smooth normals become smaller together.
TEST(KeepEdges, ConvergesWithTheMesh) {
    std::vector<double> volumes;
    for (const int frequency : {20, 40, 80, 160}) {
        TriangleMesh mesh = shapes::bumpy_sphere(frequency);
        FlowParameters parameters;
        parameters.keep_edges = 40;
        parameters.detail_size = 0.2;
        parameters.depth = static_cast<int>(std::lround(std::log2(frequency * 0.8)));
        evolve(mesh, parameters);
        volumes.push_back(shapes::volume(mesh));
        std::printf("frequency %d, depth %d: volume %.7f\n", frequency, parameters.depth,
                    volumes.back());
    }
    const double first = std::abs(volumes[1] - volumes[0]);
    const double last = std::abs(volumes[3] - volumes[2]);
    EXPECT_GT(std::log2(first / last) / 2, 1.5);
}

constexpr int kQuads = 32;

/// Two half planes that meet at a right angle, with noise inside.
TriangleMesh roof(double noise) {
    TriangleMesh mesh = shapes::square(kQuads);
    std::mt19937 random(7);
    std::normal_distribution<double> normal(0, noise);
    for (Eigen::Vector3d& p : mesh.positions) {
        const double u = p.x() - 0.5;
        const bool is_inside = std::abs(u) < 0.49 && std::abs(p.y() - 0.5) < 0.49;
        p = {u * std::sqrt(0.5), p.y(), -std::abs(u) * std::sqrt(0.5)};
        if (is_inside) p += Eigen::Vector3d(normal(random), normal(random), normal(random));
    }
    return mesh;
}

struct Ridge {
    double height;  ///< of the edge's middle above where it was, in edges
    double angle;   ///< between the means of the normals left and right of it, degrees
};

/// Measures the middle half of the edge, and the triangles at most two edges from it.
Ridge ridge_of(const TriangleMesh& mesh, const TriangleMesh& clean) {
    double height = 0;
    int count = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const Eigen::Vector3d& at = clean.positions[i];
        if (at.x() != 0 || std::abs(at.y() - 0.5) > 0.25) continue;
        height += mesh.positions[i].z();
        ++count;
    }
    Eigen::Vector3d left(0, 0, 0), right(0, 0, 0);
    for (const Triangle& t : mesh.triangles) {
        const Eigen::Vector3d middle =
            (clean.positions[t[0]] + clean.positions[t[1]] + clean.positions[t[2]]) / 3;
        if (std::abs(middle.x()) > 2.0 / kQuads || std::abs(middle.y() - 0.5) > 0.25) continue;
        const Eigen::Vector3d normal = (mesh.positions[t[1]] - mesh.positions[t[0]])
                                           .cross(mesh.positions[t[2]] - mesh.positions[t[0]]);
        (middle.x() < 0 ? left : right) += normal;
    }
    const double cosine = left.normalized().dot(right.normalized());
    return {height / count * kQuads, std::acos(cosine) * 180 / std::acos(-1.0)};
}

/// Returns the ridge after these numbers of steps. `keep_edges` of 0 is the plain flow, with steps
/// about as long as that the noise makes the others.
std::vector<Ridge> ridges(double keep_edges, const std::vector<int>& steps) {
    const TriangleMesh clean = roof(0);
    FlowParameters parameters;
    parameters.keep_edges = keep_edges;
    parameters.detail_size = (keep_edges > 0 ? 3.0 : 9.0) / kQuads;
    parameters.order = 2;
    parameters.iterations = 1;
    TriangleMesh mesh = roof(0.2 / kQuads);
    std::vector<Ridge> found;
    int done = 0;
    for (const int count : steps) {
        for (; done < count; ++done) evolve(mesh, parameters);
        found.push_back(ridge_of(mesh, clean));
        std::printf("%g degrees kept, %d steps: height %.3f edges, angle %.1f\n", keep_edges, count,
                    found.back().height, found.back().angle);
    }
    return found;
}

// An edge is not kept for ever, because its normals are smoothed, too.
TEST(KeepEdges, ARightAngleWearsOffMoreSlowly) {
    const std::vector<int> steps = {1, 10, 100};
    const std::vector<Ridge> plain = ridges(0, steps), kept = ridges(25, steps);
    const std::vector<double> shares = {0.2, 0.6, 0.9};
    for (std::size_t i = 0; i < steps.size(); ++i) {
        EXPECT_LT(std::abs(kept[i].height), shares[i] * std::abs(plain[i].height));
        EXPECT_GT(kept[i].angle, plain[i].angle + 15);
    }
    EXPECT_GT(kept[0].angle, 80);
}

}  // namespace
}  // namespace tracked_mcf
