// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/candidate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "filter_tracked_mcf/core/pi.h"

namespace tracked_mcf {
namespace {

TEST(Candidate, HalvesTheWavesOfItsDetailSize) {
    for (const int steps : {1, 2, 5}) {
        Candidate candidate;
        candidate.steps = steps;
        candidate.settings.step_size = step_size_of_candidate(7, steps);
        EXPECT_NEAR(detail_size_of(candidate), 7, 1e-12);
        const double wave = 2 * kPi / 7;
        const double kept = 1 / (1 + std::pow(candidate.settings.step_size * wave * wave, 2));
        EXPECT_NEAR(std::pow(kept, steps), 0.5, 1e-12);
    }
    EXPECT_EQ(detail_size_of(Candidate()), 0);
}

TEST(MakeStep, TakesAQuarterOfTheSizeUntilItIsMade) {
    StepSettings settings;
    settings.step_size = 64;
    EXPECT_TRUE(make_step(settings, [&] { return settings.step_size <= 1; }));
    EXPECT_EQ(settings.step_size, 1);
    EXPECT_FALSE(make_step(settings, [] { return false; }));
    EXPECT_EQ(settings.step_size, 1);
}

}  // namespace
}  // namespace tracked_mcf
