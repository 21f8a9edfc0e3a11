// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <limits>
#include <vector>

#include "filter_tracked_mcf/core/parameter_table.h"

namespace tracked_mcf {

/// Returns values of a parameter's type that are outside its range: the nearest integers beyond its
/// ends, the ends of an open range, and what is not finite. A bool has none.
inline std::vector<ParameterValue> values_outside(const Parameter& row) {
    const auto& [smallest, largest, advice, open] = row.range;
    if (std::holds_alternative<bool>(row.initial)) return {};
    if (std::holds_alternative<int>(row.initial)) {
        return {static_cast<int>(smallest) - 1, static_cast<int>(largest) + 1,
                std::numeric_limits<int>::min(), std::numeric_limits<int>::max()};
    }
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<ParameterValue> values = {smallest - 1, infinity, -infinity,
                                          std::numeric_limits<double>::quiet_NaN()};
    if (largest < kFinite) values.emplace_back(largest + 1);
    if (open) values.insert(values.end(), {smallest, largest});
    return values;
}

}  // namespace tracked_mcf
