#pragma once

#include <cstddef>
#include <limits>
#include <new>
#include <utility>
#include <vector>

namespace tracked_mcf {

/// Memory for large arrays, aligned as `new` would. Throws std::bad_alloc. Where the system lets
/// programs ask for them, from some megabytes on it consists of huge pages: these are mapped and
/// cleared in much less time, and in an array all of them are used.
void* allocate_memory(std::size_t bytes);

/// Frees what allocate_memory(bytes) returned.
void free_memory(void* memory, std::size_t bytes) noexcept;

/// An allocator with which a vector leaves new elements uninitialised if they are plain numbers:
/// threads that then fill it also share the work of touching it for the first time.
template <class T>
class RawAllocator {
public:
    using value_type = T;

    RawAllocator() = default;
    template <class U>
    RawAllocator(const RawAllocator<U>& /*other*/) noexcept {}

    T* allocate(std::size_t count) {
        static_assert(alignof(T) <= __STDCPP_DEFAULT_NEW_ALIGNMENT__);
        if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_alloc();
        return static_cast<T*>(allocate_memory(count * sizeof(T)));
    }
    void deallocate(T* memory, std::size_t count) noexcept {
        free_memory(memory, count * sizeof(T));
    }

    template <class U>
    void construct(U* place) {
        ::new (static_cast<void*>(place)) U;
    }
    template <class U, class... Arguments>
    void construct(U* place, Arguments&&... arguments) {
        ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
    }

    friend bool operator==(const RawAllocator& /*a*/, const RawAllocator& /*b*/) { return true; }
    friend bool operator!=(const RawAllocator& /*a*/, const RawAllocator& /*b*/) { return false; }
};

/// A vector for many items, each of which is written before it is read: resize() leaves them as the
/// memory was.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace tracked_mcf
