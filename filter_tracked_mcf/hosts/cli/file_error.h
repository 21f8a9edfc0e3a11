// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>

namespace tracked_mcf {

/// A mesh file cannot be read; what() names it and says what is wrong and what to do.
class UnreadableFile : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A result cannot be written; what() names the file and the reason. Old files are unchanged.
class UnwritableFile : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace tracked_mcf
