#include "filter_tracked_mcf/core/parallel.h"

#include <omp.h>

namespace tracked_mcf {

ThreadCountScope::ThreadCountScope(int threads) : previous_(omp_get_max_threads()) {
    if (threads > 0) omp_set_num_threads(threads);
}

ThreadCountScope::~ThreadCountScope() {
    omp_set_num_threads(previous_);
}

std::int64_t slice_count() {
    const int threads = omp_get_max_threads();
    return threads == 1 ? 1 : 4 * threads;
}

}  // namespace tracked_mcf
