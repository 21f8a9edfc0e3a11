// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/parallel/thread_team.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <exception>
#include <system_error>
#include <utility>

#include "filter_tracked_mcf/core/parallel/progress_meter.h"
#include "filter_tracked_mcf/core/platform/processors.h"

namespace tracked_mcf {

namespace {

thread_local ThreadTeam* current_team = nullptr;

}  // namespace

struct ThreadTeam::Loop {
    const std::int64_t count;
    const Body& body;
    std::atomic<std::int64_t> next{0};  ///< first item that nobody has taken
    std::size_t joined = 0;             ///< threads that have joined, without the owner
    std::size_t working = 0;            ///< those that may run an item
    std::exception_ptr failure{};

    bool has_items() const { return next < count; }
};

ThreadTeam::ThreadTeam(int size)
    : size_(static_cast<std::size_t>(size > 0 ? size : default_size())),
      hidden_(std::exchange(current_team, this)) {}

ThreadTeam::~ThreadTeam() {
    current_team = hidden_;
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        ends_ = true;
    }
    has_items_.notify_all();
    for (std::thread& thread : threads_) thread.join();
}

int ThreadTeam::default_size() {
    const char* const asked = std::getenv("OMP_NUM_THREADS");
    // Of a list, such as "4,2" for nested loops, the first number counts.
    const long threads = asked == nullptr ? 0 : std::strtol(asked, nullptr, 10);
    constexpr long most = 1024;
    return threads > 0 ? static_cast<int>(std::min(threads, most)) : processor_count();
}

std::size_t ThreadTeam::size() {
    return current_team == nullptr ? 1 : current_team->size_;
}

void ThreadTeam::run(std::int64_t count, const Body& body, std::int64_t worth_threads) {
    if (size() > 1 && count >= worth_threads) {
        Loop loop{count, body};
        current_team->run_with_threads(loop);
        return;
    }
    for (std::int64_t item = 0; item < count; ++item) {
        poll_progress();
        body(item, 0);
    }
}

void ThreadTeam::run_with_threads(Loop& loop) {
    start_threads(loop.count - 1);
    {
        const std::lock_guard<std::mutex> lock(mutex_);
        loop_ = &loop;
    }
    has_items_.notify_one();  // Each thread that joins wakes the next.
    run_items(loop, 0);
    std::unique_lock<std::mutex> lock(mutex_);
    loop_ = nullptr;
    is_done_.wait(lock, [&] { return loop.working == 0; });
    if (loop.failure) std::rethrow_exception(loop.failure);
}

void ThreadTeam::start_threads(std::int64_t items) {
    const std::size_t wanted = std::min(size_ - 1, static_cast<std::size_t>(items));
    try {
        while (threads_.size() < wanted) threads_.emplace_back([this] { serve(); });
    } catch (const std::system_error&) {
        return;  // The next loop tries again.
    }
}

void ThreadTeam::serve() {
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
        has_items_.wait(lock, [&] { return ends_ || (loop_ != nullptr && loop_->has_items()); });
        if (ends_) return;
        Loop& loop = *loop_;
        const std::size_t member = ++loop.joined;
        ++loop.working;
        lock.unlock();
        has_items_.notify_one();
        run_items(loop, member);
        lock.lock();
        if (--loop.working == 0) is_done_.notify_one();
    }
}

void ThreadTeam::run_items(Loop& loop, std::size_t member) {
    // Loops inside a body run in its thread alone: the team is busy.
    ThreadTeam* const team = std::exchange(current_team, nullptr);
    try {
        for (std::int64_t item = loop.next++; item < loop.count; item = loop.next++) {
            poll_progress();
            loop.body(item, member);
        }
    } catch (...) {
        loop.next = loop.count;
        const std::lock_guard<std::mutex> lock(mutex_);
        if (!loop.failure) loop.failure = std::current_exception();
    }
    current_team = team;
}

}  // namespace tracked_mcf
