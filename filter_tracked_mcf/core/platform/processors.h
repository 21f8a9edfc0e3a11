// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace tracked_mcf {

/// Returns how many processors this process may use at once: those on which it may run or, if its
/// control groups allow it less time, that time divided by the elapsed time, rounded up.
int processor_count();

/// Returns the least quota of this process's control groups in processors, rounded up, or a number
/// larger than any machine's if there is none. Reads Linux's files, whose paths follow `root`: a
/// test's folder or "".
int processor_quota(const std::string& root);

}  // namespace tracked_mcf
