#pragma once

#include <cstdint>
#include <string>

namespace tracked_mcf {

/// Bytes that this process can still get: the least of what the machine has free, swap space
/// included, of what its control groups allow, and of what its own limits do. At least 1; 0 where
/// the system does not say. Never throws.
std::int64_t available_memory_bytes() noexcept;

/// The part of that which files say, looked for below `root`, "/" but for tests.
std::int64_t available_memory_by_files(const std::string& root) noexcept;

}  // namespace tracked_mcf
