// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace tracked_mcf {

/// Rims that run beside each other with hardly a gap. Files have them where one point was written
/// twice, with different rounding.
struct CrackReport {
    std::int64_t joined_vertices = 0;  ///< that count as one with another, as coincident ones do
    std::int64_t open_pairs = 0;       ///< pairs of vertices that are farther apart: they stay two
    double open_width = 0;             ///< the largest distance of such a pair, mesh units
};

}  // namespace tracked_mcf
