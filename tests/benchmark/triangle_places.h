#pragma once

#include <cstdint>

namespace tracked_mcf::benchmark {

/// Where the parts of one triangle's element matrix go.
struct TrianglePlaces {
    std::int32_t vertices[3];
    std::int32_t entries[3];  ///< of the edge opposite to each corner
};

}  // namespace tracked_mcf::benchmark
