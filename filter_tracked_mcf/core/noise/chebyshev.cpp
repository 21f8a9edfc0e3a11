// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/chebyshev.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace tracked_mcf {

// The function is the real part of 1 / (t - i). With t = largest (x + 1) / 2, this is
// -2 / largest / (z - x) for z = 2i / largest - 1, and 1 / (z - x) has the series
// (1 + 2 Σ ζ^k T_k(x)) / √(z² - 1), where ζ = z - √(z² - 1) is inside the unit circle.
std::vector<double> series_of_filter(double largest, double tolerance) {
    const std::complex<double> z(-1, 2 / largest);
    std::complex<double> root = std::sqrt(z * z - 1.0);
    if (std::abs(z - root) > 1) root = -root;
    const std::complex<double> ratio = z - root;
    std::complex<double> term = -2 / largest / root;
    std::vector<double> coefficients = {term.real()};
    term *= 2;
    do {
        term *= ratio;
        coefficients.push_back(term.real());
    } while (std::abs(term * ratio) > tolerance * (1 - std::abs(ratio)));
    return coefficients;
}

ChebyshevAcceleration::ChebyshevAcceleration(double low, double high)
    : gamma_(2 / (high + low)), ratio_((high - low) / (high + low)) {}

int ChebyshevAcceleration::steps(double reduction) const {
    const double rate = ratio_ / (1 + std::sqrt(1 - ratio_ * ratio_));
    return std::max(1, static_cast<int>(std::ceil(std::log(reduction / 2) / std::log(rate))));
}

void ChebyshevAcceleration::advance() {
    const bool is_second = omega_ == 1;
    omega_ = 1 / (1 - ratio_ * ratio_ * omega_ / (is_second ? 2 : 4));
}

}  // namespace tracked_mcf
