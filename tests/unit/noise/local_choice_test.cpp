// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/local_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "filter_tracked_mcf/core/noise/cross_validation.h"
#include "tests/support/shapes.h"
#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

/// A square of 80 x 80 cells of which one half has waves.
struct HalfWavy {
    explicit HalfWavy(double deviation) {
        TriangleMesh mesh = shapes::square(80);
        const double edge = mean_edge_length(mesh);
        std::mt19937 random(1);
        std::normal_distribution<double> normal(0, deviation * edge);
        for (Eigen::Vector3d& p : mesh.positions) {
            const double height = p.x() > 0.5 ? 0.5 * edge * std::sin(p.y() / edge) : 0;
            clean.push_back(height / edge);
            p.z() = height + normal(random);
        }
        surface = surface_of_mesh(mesh);
        origin = surface.positions.front().z() - mesh.positions.front().z() / edge;
    }

    /// Returns the RMS error of heights in edges.
    double error(const Positions& positions) const {
        double squares = 0;
        for (std::size_t i = 0; i < clean.size(); ++i) {
            const double error = positions[i].z() - origin - clean[i];
            squares += error * error;
        }
        return std::sqrt(squares / static_cast<double>(clean.size()));
    }

    std::vector<double> clean;
    NoisySurface surface;
    double origin = 0;
};

const Candidate kWeak = {{0, 0.3, 2}, 1, {}}, kStrong = {{0, 2.4, 2}, 4, {}};

TEST(LocalChoice, GivesEachPlaceTheCandidateThatSuitsIt) {
    const double noise = 0.2;
    const HalfWavy wavy(noise);
    const std::vector<Candidate> candidates = {kWeak, kStrong};
    const Perturbation perturbation = perturbation_of(wavy.surface, kWeak.settings, noise);
    const Results results = apply(wavy.surface, candidates, perturbation);
    const double best =
        std::min(wavy.error(results.positions[0]), wavy.error(results.positions[1]));
    EXPECT_LT(wavy.error(chosen_locally(wavy.surface, perturbation, results)), 0.85 * best);
}

TEST(LocalChoice, AddsWhatTheMetricMakesOfNoise) {
    const HalfWavy wavy(0.2);
    const Perturbation perturbation = perturbation_of(wavy.surface, kWeak.settings, 0.2);
    Results results = apply(wavy.surface, {kWeak, kStrong}, perturbation);
    results.made[1].divergence_of_metric = 1;
    EXPECT_EQ(chosen_locally(wavy.surface, perturbation, results), results.positions[0]);
}

TEST(LocalChoice, KeepsTheFirstCandidateWhereNoOtherIsBetter) {
    const double noise = 0.2;
    const NoisySurface surface = surface_of_mesh(with_noise(shapes::geodesic_sphere(20), noise));
    const Perturbation perturbation = perturbation_of(surface, kStrong.settings, noise);
    const Candidate none = {{0, 1e-3, 2}, 1, {}};
    const Results results = apply(surface, {kStrong, none}, perturbation);
    EXPECT_EQ(chosen_locally(surface, perturbation, results), results.positions[0]);
}

TEST(LocalChoice, KnowsNoiseThatVaries) {
    for (const bool varies : {false, true}) {
        TriangleMesh mesh = shapes::square(60);
        const double edge = mean_edge_length(mesh);
        std::mt19937 random(1);
        std::normal_distribution<double> normal;
        for (Eigen::Vector3d& p : mesh.positions) {
            p.z() = (varies && p.x() > 0.5 ? 0.3 : 0.1) * edge * normal(random);
        }
        const NoisySurface surface = surface_of_mesh(mesh);
        const Perturbation perturbation = perturbation_of(surface, kStrong.settings, 0.2);
        const Results results = apply(surface, {kStrong});
        EXPECT_EQ(is_uneven(surface, perturbation, results.positions[0]), varies);
    }
}

TEST(LocalChoice, TakesFewCandidatesThatComplementEachOther) {
    const HalfWavy wavy(0.2);
    const Sample sample = sample_of(wavy.surface, 10000);
    const std::size_t count = sample.counts.size();
    Risks left(count), right(count), worse(count, 1), middle(count, 0.5F);
    for (std::size_t i = 0; i < count; ++i) {
        const bool is_left = wavy.surface.positions[i].x() < 0;
        left[i] = is_left ? 0 : 2;
        right[i] = is_left ? 2 : 0.1F;
    }
    const std::vector<Risks> risks = {worse, middle, left, right};
    EXPECT_EQ(best_few(sample, risks, 1, 4), (std::vector<std::size_t>{1, 2, 3}));
    EXPECT_EQ(best_few(sample, risks, 1, 2), (std::vector<std::size_t>{1, 2}));
    EXPECT_EQ(best_few(sample, {middle, worse}, 0, 5), std::vector<std::size_t>{0});
}

TEST(Candidates, ShareTheirSteps) {
    const NoisySurface surface = surface_of_mesh(with_noise(shapes::geodesic_sphere(10), 0.2));
    const Candidate once = {{0.5, 0.3, 2}, 1, {}};
    Candidate twice = once, sharp = once, other = once;
    twice.steps = 2;
    sharp.sharpening = {0.3, 3};
    Candidate sharper = sharp;
    sharper.sharpening.iterations = 5;
    other.settings.step_size = 1;
    const std::vector<Candidate> all = {once, sharper, other, twice, sharp};
    const Results together = apply(surface, all);
    EXPECT_TRUE(share_steps(once, twice));
    EXPECT_FALSE(share_steps(once, other));
    for (std::size_t i = 0; i < all.size(); ++i) {
        const Results alone = apply(surface, {all[i]});
        EXPECT_EQ(together.positions[i], alone.positions[0]) << i;
    }
    EXPECT_LT(together.iterations, apply(surface, {once}).iterations +
                                       apply(surface, {other}).iterations +
                                       apply(surface, {twice}).iterations);
}

}  // namespace
}  // namespace tracked_mcf
