#pragma once

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace tracked_mcf {

/// An allocator with which a vector leaves new elements uninitialised if they are plain numbers:
/// threads that then fill it also share the work of touching it for the first time.
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
    void construct(U* place) {
        ::new (static_cast<void*>(place)) U;
    }
    template <class U, class... Arguments>
    void construct(U* place, Arguments&&... arguments) {
        ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
    }
};

/// A vector for many items, each of which is written before it is read: resize() leaves them as the
/// memory was.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace tracked_mcf
