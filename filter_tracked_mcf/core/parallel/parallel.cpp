// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/parallel/parallel.h"

#ifdef _OPENMP
#include <omp.h>
#ifndef _WIN32
#include <pthread.h>
#endif
#endif

namespace tracked_mcf {

#ifdef _OPENMP

namespace {

std::atomic<bool> forked{false};

}  // namespace

bool may_use_threads() {
#ifndef _WIN32  // Windows does not fork.
    [[maybe_unused]] static const int registered =
        pthread_atfork(nullptr, nullptr, [] { forked = true; });
#endif
    return !forked;
}

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
bool may_use_threads() {
    return false;
}

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
