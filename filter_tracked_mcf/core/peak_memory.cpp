#include "filter_tracked_mcf/core/peak_memory.h"

#if __has_include(<sys/resource.h>)
#include <sys/resource.h>
#endif

namespace tracked_mcf {

std::int64_t peak_memory_bytes() {
#if __has_include(<sys/resource.h>)
    rusage usage{};
    if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
    constexpr std::int64_t kUnit = 1024;  // Linux counts in kilobytes
    return usage.ru_maxrss * kUnit;
#else
    return 0;
#endif
}

}  // namespace tracked_mcf
