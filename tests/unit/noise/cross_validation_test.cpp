// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/cross_validation.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/support/shapes.h"
#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

constexpr double kCrease = 0.43;  // 25 degrees

Sample sample_of_mesh(const TriangleMesh& mesh) {
    return sample_of(surface_of_mesh(mesh), 4000);
}

NoiseRequest automatic() {
    NoiseRequest request;
    request.crease = kCrease;
    return request;
}

TEST(CrossValidation, FindsNoCandidateForACleanSurface) {
    const Choice choice = best_candidate(sample_of_mesh(shapes::bumpy_sphere(30)), automatic());
    EXPECT_EQ(choice.candidate.steps, 0);
    EXPECT_TRUE(choice.others.empty());
}

TEST(CrossValidation, SmoothsTheMoreTheMoreNoiseThereIs) {
    double last = 0;
    for (const double deviation : {0.05, 0.1, 0.3}) {
        const Choice choice = best_candidate(
            sample_of_mesh(with_noise(shapes::bumpy_sphere(30), deviation)), automatic());
        EXPECT_NEAR(choice.noise, deviation, 0.1 * deviation);
        EXPECT_EQ(choice.kind, NoiseKind::White);
        EXPECT_GT(detail_size_of(choice.candidate), last);
        last = detail_size_of(choice.candidate);
    }
}

TEST(CrossValidation, FindsTheNoiseOfKnownShapes) {
    for (const TriangleMesh& clean :
         {shapes::square(60), shapes::geodesic_sphere(20), shapes::box(25, {1, 1, 1})}) {
        for (const double deviation : {0.05, 0.2, 0.5}) {
            const TriangleMesh mesh = with_noise(clean, deviation);
            // Noise makes edges longer, in which it is measured.
            const double expected = deviation * mean_edge_length(clean) / mean_edge_length(mesh);
            const Choice choice = best_candidate(sample_of_mesh(mesh), automatic());
            EXPECT_NEAR(choice.noise, expected, 0.05 * expected) << deviation;
        }
    }
}

TEST(CrossValidation, NamesOthersOnlyWithoutWishes) {
    const Sample sample = sample_of_mesh(with_noise(shapes::box(25, {1, 1, 1}), 0.2));
    const Choice choice = best_candidate(sample, automatic());
    EXPECT_GT(choice.others.size(), 0U);
    EXPECT_LT(choice.others.size(), 5U);
    NoiseRequest request = automatic();
    request.noise = 0.2;
    EXPECT_TRUE(best_candidate(sample, request).others.empty());
    request = automatic();
    request.detail_size = 6;
    EXPECT_TRUE(best_candidate(sample, request).others.empty());
}

TEST(CrossValidation, NamesOthersThatShareTheStepsIfItIsToBeQuick) {
    const Sample sample = sample_of_mesh(with_noise(shapes::box(25, {1, 1, 1}), 0.2));
    NoiseRequest request = automatic();
    request.is_quick = true;
    const Choice choice = best_candidate(sample, request);
    EXPECT_GT(choice.others.size(), 0U);
    EXPECT_LT(choice.others.size(), 3U);
    for (const Candidate& other : choice.others) {
        EXPECT_TRUE(share_steps(other, choice.candidate));
    }
}

TEST(CrossValidation, WhitensHeightsByTheirFidelities) {
    TriangleMesh mesh = shapes::bumpy_sphere(30);
    const std::vector<Eigen::Vector3d> normals = vertex_normals(mesh);
    const double edge = mean_edge_length(mesh);
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    std::vector<float> fidelities;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const bool is_noisy = i % 5 == 0;
        mesh.positions[i] += (is_noisy ? 0.5 : 0.05) * edge * normal(random) * normals[i];
        fidelities.push_back(is_noisy ? 0.01F : 1);
    }
    const NoisySurface surface = surface_of_mesh(mesh);
    NoiseRequest request = automatic();
    request.is_certain = true;
    const Choice choice = best_candidate(sample_of(surface, 10000, fidelities), request);
    EXPECT_NEAR(choice.noise, 0.05, 0.01);
}

}  // namespace
}  // namespace tracked_mcf
