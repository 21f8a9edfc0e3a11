// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/parallel/parallel.h"

#ifdef _OPENMP
#include <omp.h>
#endif

namespace tracked_mcf {

#ifdef _OPENMP

ThreadCountScope::ThreadCountScope(int threads) : previous_(omp_get_max_threads()) {
    if (threads > 0) omp_set_num_threads(threads);
}

ThreadCountScope::~ThreadCountScope() {
    omp_set_num_threads(previous_);
}

std::size_t thread_count() {
    return static_cast<std::size_t>(omp_get_max_threads());
}

std::size_t thread_number() {
    return static_cast<std::size_t>(omp_get_thread_num());
}
#else
ThreadCountScope::ThreadCountScope(int /*threads*/) : previous_(1) {}

ThreadCountScope::~ThreadCountScope() {
    static_cast<void>(previous_);  // clang would call it unused
}

std::size_t thread_count() {
    return 1;
}

std::size_t thread_number() {
    return 0;
}
#endif

}  // namespace tracked_mcf
