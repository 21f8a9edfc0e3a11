// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

namespace tracked_mcf {

/// Returns the coefficients of the Chebyshev series of t / (1 + t²) on [0, `largest`], in
/// T_k(2 t / largest - 1) for k = 0, 1, ... The sum of those that are left out, and so the error,
/// is at most `tolerance`.
std::vector<double> series_of_filter(double largest, double tolerance);

/// The Chebyshev acceleration of x ← J(x), where the eigenvalues of I - J' are in [low, high]:
/// x_next = ω (x + γ (J(x) - x)) + (1 - ω) x_before (Golub and Varga, "Chebyshev semi-iterative
/// methods", 1961). It needs no products of vectors, and is the same for all right-hand sides.
class ChebyshevAcceleration {
public:
    ChebyshevAcceleration(double low, double high);

    /// Returns the number of steps after which the error is at most `reduction` times what it was.
    int steps(double reduction) const;

    /// Goes on to the next step; call it before each one.
    void advance();
    float omega() const { return static_cast<float>(omega_); }
    float gamma() const { return static_cast<float>(gamma_); }

private:
    double gamma_, ratio_;
    double omega_ = 0;  ///< 1 in the first step
};

}  // namespace tracked_mcf
