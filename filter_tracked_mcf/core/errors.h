#pragma once

#include <stdexcept>

namespace tracked_mcf {

/// Base of what the core throws by itself (memory can run out besides, and a callback's own
/// exceptions pass through). what() says, in one sentence a user can act on, what is wrong and what
/// to do. Whenever one is thrown the caller's mesh has not been touched.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// The mesh cannot be flowed: empty, not finite, all triangles degenerate.
class InvalidMesh : public Error {
public:
    using Error::Error;
};

/// A parameter lies outside its range.
class InvalidParameter : public Error {
public:
    using Error::Error;
};

/// The numbers stopped being finite during the flow.
class NumericalFailure : public Error {
public:
    using Error::Error;
};

/// The flow is expected to need more memory than there is.
class NotEnoughMemory : public Error {
public:
    using Error::Error;
};

/// The progress callback asked to stop.
class Cancelled : public Error {
public:
    using Error::Error;
};

}  // namespace tracked_mcf
