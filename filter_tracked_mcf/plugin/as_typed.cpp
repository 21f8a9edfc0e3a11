// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/plugin/as_typed.h"

#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

namespace tracked_mcf {

namespace {

/// Returns the double nearest to the decimal number of so many digits that is nearest to `value`.
/// Some standard libraries lack std::to_chars for floats.
double rounded(double value, int digits) {
    std::stringstream text;
    text.imbue(std::locale::classic());
    text.precision(digits);
    text << value;
    text >> value;
    return value;
}

}  // namespace

double as_typed(double value) {
    if (!std::isfinite(value) || std::abs(value) > std::numeric_limits<float>::max()) return value;
    const auto as_float = static_cast<float>(value);
    if (as_float != value) return value;
    // The fewest digits that tell the float from its neighbours. Nine always do.
    double decimal = value;
    for (int digits = 1; digits == 1 || static_cast<float>(decimal) != as_float; ++digits) {
        decimal = rounded(value, digits);
    }
    return decimal;
}

}  // namespace tracked_mcf
