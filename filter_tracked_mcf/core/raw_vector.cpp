#include "filter_tracked_mcf/core/raw_vector.h"

#include <cstdlib>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace tracked_mcf {

namespace {

#ifdef __linux__
constexpr std::size_t kHugePage = std::size_t{1} << 21U;

/// From here on, what an array leaves unused of its last huge page is little.
constexpr std::size_t kWorthHugePages = 4 * kHugePage;

void* allocate_huge_pages(std::size_t bytes) {
    const std::size_t whole_pages = (bytes + kHugePage - 1) / kHugePage * kHugePage;
    if (whole_pages < bytes) throw std::bad_alloc();
    void* const memory = std::aligned_alloc(kHugePage, whole_pages);
    if (memory == nullptr) throw std::bad_alloc();
    // Only advice: if it is not followed, the memory is as good, if slower.
    madvise(memory, bytes / kHugePage * kHugePage, MADV_HUGEPAGE);
    return memory;
}
#endif

}  // namespace

#ifdef __linux__
void* allocate_memory(std::size_t bytes) {
    return bytes < kWorthHugePages ? ::operator new(bytes) : allocate_huge_pages(bytes);
}

void free_memory(void* memory, std::size_t bytes) noexcept {
    if (bytes < kWorthHugePages) {
        ::operator delete(memory);
    } else {
        std::free(memory);
    }
}
#else
void* allocate_memory(std::size_t bytes) {
    return ::operator new(bytes);
}

void free_memory(void* memory, std::size_t /*bytes*/) noexcept {
    ::operator delete(memory);
}
#endif

}  // namespace tracked_mcf
