#include "filter_tracked_mcf/core/peak_memory.h"

#if __has_include(<sys/resource.h>)
#include <sys/resource.h>
#endif

namespace tracked_mcf {

std::int64_t peak_memory_bytes() {
#if __has_include(<sys/resource.h>)
    rusage usage{};
    if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
    return std::int64_t{1024} * usage.ru_maxrss;  // Linux counts in kilobytes
#else
    return 0;
#endif
}

}  // namespace tracked_mcf
