// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

namespace tracked_mcf::benchmark {

/// The indices at which one triangle adds its element matrix.
struct TriangleIndices {
    std::int32_t vertices[3];
    std::int32_t entries[3];  ///< the matrix entry of the edge opposite to each corner
};

}  // namespace tracked_mcf::benchmark
