// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/fidelities.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "tests/support/shapes.h"
#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

/// A square of 60 x 60 cells, and heights of its vertices with deviations that a function of x
/// gives.
struct Heights {
    explicit Heights(const std::function<double(double)>& deviation)
        : surface(surface_of_mesh(shapes::square(60))), counts(surface.positions.size(), 1) {
        double width = 0;
        for (const Eigen::Vector3d& p : surface.positions) width = std::max(width, p.x());
        for (const Eigen::Vector3d& p : surface.positions) {
            const double x = (p.x() / width + 1) / 2;
            values.push_back(static_cast<float>(deviation(x) * normal(random)));
        }
    }

    NoiseKind kind() const { return kind_of_noise(surface.stars, values, counts); }

    std::mt19937 random{1};
    std::normal_distribution<double> normal;
    NoisySurface surface;
    std::vector<std::uint8_t> counts;
    std::vector<float> values;
};

/// Returns heights of which every fifth, at random, is far from 0.
Heights with_impulses(double usual, double far, std::vector<bool>& is_far) {
    Heights heights([&](double /*x*/) { return usual; });
    std::uniform_real_distribution<double> uniform;
    for (float& value : heights.values) {
        is_far.push_back(uniform(heights.random) < 0.2);
        if (is_far.back()) value = static_cast<float>(value < 0 ? -far : far);
    }
    return heights;
}

TEST(Fidelities, TellWhatNoiseThereIs) {
    EXPECT_EQ(Heights([](double /*x*/) { return 0.2; }).kind(), NoiseKind::White);
    EXPECT_EQ(Heights([](double x) { return x < 0.5 ? 0.1 : 0.3; }).kind(), NoiseKind::Varying);
    std::vector<bool> is_far;
    EXPECT_EQ(with_impulses(0.02, 0.4, is_far).kind(), NoiseKind::Outliers);
    EXPECT_NE(with_impulses(2e-4, 4e-3, is_far).kind(), NoiseKind::Outliers)
        << "what stands out by so little is detail";
}

TEST(Fidelities, TakeALineOfLargeHeightsForDetail) {
    Heights heights([](double /*x*/) { return 0.02; });
    for (std::size_t i = 0; i < heights.values.size(); ++i) {
        const double x = std::abs(heights.surface.positions[i].x());
        if (std::fmod(x + 0.1, 8) < 0.5) heights.values[i] = 0.4F;
    }
    EXPECT_NE(heights.kind(), NoiseKind::Outliers);
    std::shuffle(heights.values.begin(), heights.values.end(), heights.random);
    EXPECT_EQ(heights.kind(), NoiseKind::Outliers) << "the same heights, at random places";
}

TEST(Fidelities, AreThoseOfVerticesThatCount) {
    Heights heights([](double x) { return x < 0.5 ? 0.1 : 0.3; });
    for (std::size_t i = 0; i < heights.counts.size(); ++i) {
        heights.counts[i] = heights.surface.positions[i].x() < -10 ? 1 : 0;
    }
    EXPECT_EQ(heights.kind(), NoiseKind::White);
}

TEST(Fidelities, AreSmallAtOutliersAlone) {
    std::vector<bool> is_far;
    const Heights heights = with_impulses(0.02, 0.4, is_far);
    const std::vector<float> fidelities =
        fidelities_to_outliers(heights.surface.stars, heights.values);
    for (std::size_t i = 0; i < fidelities.size(); ++i) {
        if (is_far[i]) {
            EXPECT_LT(fidelities[i], 0.1F);
        } else {
            EXPECT_GT(fidelities[i], 0.3F);
        }
    }
}

TEST(Fidelities, FallWithNoiseThatVaries) {
    const Heights heights([](double x) { return x < 0.5 ? 0.1 : 0.3; });
    const std::vector<float> fidelities =
        fidelities_to_noise(heights.surface.stars, heights.values);
    double left = 0, right = 0;
    for (std::size_t i = 0; i < fidelities.size(); ++i) {
        const double x = heights.surface.positions[i].x();
        if (x < -10) left += std::log(double{fidelities[i]});
        if (x > 10) right += std::log(double{fidelities[i]});
    }
    const double count = static_cast<double>(fidelities.size()) / 3;
    EXPECT_NEAR(std::exp((left - right) / count), std::pow(3, 1.5), 1.2);
}

TEST(Fidelities, AreFiniteForAnyHeights) {
    for (const double deviation : {0.0, 1e-30, 1e15}) {
        const Heights heights([&](double x) { return x < 0.1 ? 0 : deviation; });
        for (const std::vector<float>& fidelities :
             {fidelities_to_noise(heights.surface.stars, heights.values),
              fidelities_to_outliers(heights.surface.stars, heights.values)}) {
            for (const float fidelity : fidelities) {
                EXPECT_GE(fidelity, 0.003F);
                EXPECT_LE(fidelity, 1000);
            }
        }
    }
}

}  // namespace
}  // namespace tracked_mcf
