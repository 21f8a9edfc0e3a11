// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/chebyshev.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tracked_mcf {
namespace {

TEST(Chebyshev, SeriesOfTheFilterIsItsValue) {
    for (const double largest : {0.01, 1.0, 16.0, 12000.0}) {
        for (const double tolerance : {1e-2, 1e-6}) {
            const std::vector<double> series = series_of_filter(largest, tolerance);
            double worst = 0;
            for (int i = 0; i <= 1000; ++i) {
                const double angle = std::acos(-1.0) * i / 1000;
                const double t = largest * (1 + std::cos(angle)) / 2;
                double sum = 0;
                for (std::size_t k = 0; k < series.size(); ++k)
                    sum += series[k] * std::cos(static_cast<double>(k) * angle);
                worst = std::max(worst, std::abs(sum - t / (1 + t * t)));
            }
            EXPECT_LE(worst, tolerance) << largest;
        }
    }
    // Each term divides the error by 1.43 or more.
    EXPECT_LT(series_of_filter(16, 3e-3).size(), 20U);
}

// The iteration x <- c x for 0 has the error c^n; accelerated, that of a Chebyshev polynomial.
TEST(Chebyshev, AccelerationReducesTheErrorOfEveryEigenvalue) {
    const double low = 0.1, high = 1.9;
    for (const double reduction : {0.3, 0.02}) {
        for (int k = 0; k <= 36; ++k) {
            const double eigenvalue = low + k * (high - low) / 36;
            ChebyshevAcceleration acceleration(low, high);
            double before = 0, x = 1;
            const int steps = acceleration.steps(reduction);
            for (int i = 0; i < steps; ++i) {
                acceleration.advance();
                const double omega = double{acceleration.omega()};
                const double next = omega * (x - double{acceleration.gamma()} * eigenvalue * x) +
                                    (1 - omega) * before;
                before = x;
                x = next;
            }
            EXPECT_LE(std::abs(x), reduction) << eigenvalue;
        }
    }
    EXPECT_LT(ChebyshevAcceleration(low, high).steps(0.02), 11);
    EXPECT_EQ(ChebyshevAcceleration(1, 1).steps(0.02), 1);
}

}  // namespace
}  // namespace tracked_mcf
