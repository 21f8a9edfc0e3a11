#pragma once

#include <cstdint>

namespace tracked_mcf {

/// Largest resident memory of this process so far, bytes; 0 where the system does not say.
std::int64_t peak_memory_bytes();

}  // namespace tracked_mcf
