// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <vector>

namespace tracked_mcf {

/// Values at equal distances.
struct Comb {
    double distance = 0, first = 0;

    double index_of(double value) const { return (value - first) / distance; }
};

inline double from_whole(double number) {
    return std::abs(number - std::round(number));
}

/// Coordinates on a lattice are whole up to this, in cells.
inline constexpr double kWhole = 0.06;

/// Returns the widest comb that nearly all values are on, which are in edges. Its distance is 0 if
/// there is none.
Comb comb_of(const std::vector<double>& values);

/// Returns whether at least a tenth of the values are equal to another one.
bool has_equal_values(const std::vector<double>& values);

/// Returns combs that the commonest values are on. Other values may be anywhere.
std::vector<Comb> combs_of_commonest(const std::vector<double>& values);

}  // namespace tracked_mcf
