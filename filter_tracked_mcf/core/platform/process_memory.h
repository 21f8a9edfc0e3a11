// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

namespace tracked_mcf {

/// Returns how many bytes this process can still allocate: the least of the machine's free memory
/// with its swap space and of what other limits leave. On Unix, these are the limits of the control
/// groups (cgroups) and of the process; on Windows, the address space. At least 1, or 0 if the
/// system does not report it.
std::int64_t available_memory_bytes();

/// Returns the same from Linux's files alone, whose paths follow `root`: a test's folder or "". Not
/// defined on Windows.
std::int64_t available_memory_by_files(const std::string& root);

/// Returns the resident memory of this process in bytes, or 0 if the system does not report it.
std::int64_t resident_memory_bytes();

/// Returns the largest resident memory of this process so far, in bytes, or 0 if the system does
/// not report it.
std::int64_t peak_memory_bytes();

/// Returns a number such as "3.7 GB", "37 GB" or "370 MB".
std::string bytes_in_words(double bytes);

/// Throws NotEnoughMemory if `task` ("Removing noise") needs these bytes and fewer are free: as
/// many as the environment variable TRACKED_MCF_FREE_MEMORY says, or else available_memory_bytes().
/// The message ends with `advice`. Throws InvalidParameter if the variable is no number.
void check_free_memory(double bytes, const std::string& task, const std::string& advice);

}  // namespace tracked_mcf
