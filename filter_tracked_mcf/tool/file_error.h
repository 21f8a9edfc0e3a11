#pragma once

#include <stdexcept>

namespace tracked_mcf {

/// A mesh file cannot be read: what() names it, says what is wrong with it and what to do.
class UnreadableFile : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// A result cannot be written: what() names the file and says why. Nothing has been overwritten.
class UnwritableFile : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

}  // namespace tracked_mcf
