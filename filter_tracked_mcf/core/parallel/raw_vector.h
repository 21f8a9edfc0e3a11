// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace tracked_mcf {

/// An allocator whose vectors default-initialise new elements, so that numbers stay uninitialised.
/// The threads that then fill a vector share the cost of the first access to its memory.
template <class T>
class RawAllocator : public std::allocator<T> {
public:
    template <class U>
    struct rebind {  // NOLINT(readability-identifier-naming): the library's name
        using other = RawAllocator<U>;
    };

    RawAllocator() = default;
    template <class U>
    RawAllocator(const RawAllocator<U>& /*other*/) noexcept {}

    template <class U>
    void construct(U* location) {
        ::new (static_cast<void*>(location)) U;
    }
    template <class U, class... Arguments>
    void construct(U* location, Arguments&&... arguments) {
        ::new (static_cast<void*>(location)) U(std::forward<Arguments>(arguments)...);
    }
};

/// A vector whose resize() leaves new numbers uninitialised: every item must be written before it
/// is read.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace tracked_mcf
