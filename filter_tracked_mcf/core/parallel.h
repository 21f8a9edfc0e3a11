#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <numeric>
#include <optional>
#include <vector>

#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/progress_meter.h"

namespace tracked_mcf {

/// While it lives, loops started from this thread use `threads` OpenMP threads; 0 leaves OpenMP's
/// own choice. Restored at the end, since hosts use OpenMP too.
class ThreadCountScope {
public:
    explicit ThreadCountScope(int threads);
    ~ThreadCountScope();
    ThreadCountScope(const ThreadCountScope&) = delete;
    ThreadCountScope& operator=(const ThreadCountScope&) = delete;

private:
    int previous_;
};

/// Threads that a loop started from here may have, and which of them, from 0, the caller is.
std::size_t thread_count();
std::size_t thread_number();

/// Calls body(i) for every i in [0, count), in any order and, from `worth_threads` of them on, in
/// parallel. The first exception of a body is thrown on after the loop, of which the rest is left
/// out; it must not leave an OpenMP region by itself. Progress is polled before every body of the
/// calling thread, which has a meter if any has one.
template <class Body>
void parallel_for(std::int64_t count, const Body& body, std::int64_t worth_threads = 2) {
    std::exception_ptr failure;
    std::atomic<bool> failed{false};
#pragma omp parallel for schedule(dynamic, 1) if (count >= worth_threads)
    for (std::int64_t i = 0; i < count; ++i) {
        if (failed.load(std::memory_order_relaxed)) continue;
        try {
            poll_progress();
            body(i);
        } catch (...) {
            if (!failed.exchange(true)) failure = std::current_exception();
        }
    }
    if (failure) std::rethrow_exception(failure);
}

/// Blocks are of a fixed size, whatever the number of threads, so that what is summed or collected
/// by blocks, in their order, is the same bits at any number of threads.
inline constexpr std::int64_t kBlockSize = 1024;

inline std::int64_t block_count(std::int64_t count) {
    return (count + kBlockSize - 1) / kBlockSize;
}

/// Calls body(begin, end) for consecutive blocks that cover [0, count), in parallel.
template <class Body>
void parallel_for_blocks(std::int64_t count, const Body& body) {
    parallel_for(block_count(count), [&](std::int64_t block) {
        body(block * kBlockSize, std::min(count, (block + 1) * kBlockSize));
    });
}

/// Blocks of light work that outweigh waking and joining threads.
inline constexpr std::int64_t kBlocksWorthThreads = 16;

/// Calls body(row) for the rows of a matrix or vector, in parallel where there are enough of them.
template <class Body>
void parallel_for_rows(std::int64_t count, const Body& body) {
    parallel_for(
        block_count(count),
        [&](std::int64_t block) {
            const auto end = static_cast<std::int32_t>(std::min(count, (block + 1) * kBlockSize));
            for (auto row = static_cast<std::int32_t>(block * kBlockSize); row < end; ++row) {
                body(row);
            }
        },
        kBlocksWorthThreads);
}

/// Calls body(workspace, begin, end) for consecutive blocks that cover [0, count), in parallel.
/// Each thread that gets any has a workspace of its own, what make() returns. The results must not
/// depend on which blocks, in which order, have had the same one.
template <class Make, class Body>
void parallel_for_blocks_with(std::int64_t count, const Make& make, const Body& body) {
    std::vector<std::optional<decltype(make())>> workspaces(thread_count());
    parallel_for_blocks(count, [&](std::int64_t begin, std::int64_t end) {
        auto& workspace = workspaces[thread_number()];
        if (!workspace) workspace.emplace(make());
        body(*workspace, begin, end);
    });
}

/// `zero` plus body(begin, end) over the blocks that cover [0, count), added in order.
template <class Value, class Body>
Value parallel_sum(std::int64_t count, const Value& zero, const Body& body) {
    std::vector<Value> sums(static_cast<std::size_t>(block_count(count)));
    parallel_for_blocks(count, [&](std::int64_t begin, std::int64_t end) {
        sums[begin / kBlockSize] = body(begin, end);
    });
    return std::accumulate(sums.begin(), sums.end(), zero);
}

/// Calls body(begin, end, out) for the blocks that cover [0, count), in parallel; each appends to a
/// vector of its own. Returns all that was appended, in the order of the blocks.
template <class Item, class Body>
std::vector<Item> parallel_collect(std::int64_t count, const Body& body) {
    std::vector<std::vector<Item>> parts(static_cast<std::size_t>(block_count(count)));
    parallel_for_blocks(count, [&](std::int64_t begin, std::int64_t end) {
        body(begin, end, parts[begin / kBlockSize]);
    });
    std::vector<std::size_t> offsets(parts.size() + 1, 0);
    for (std::size_t part = 0; part < parts.size(); ++part) {
        offsets[part + 1] = offsets[part] + parts[part].size();
    }
    std::vector<Item> all;
    resize(all, static_cast<std::int64_t>(offsets.back()));
    parallel_for(static_cast<std::int64_t>(parts.size()), [&](std::int64_t part) {
        std::copy(parts[part].begin(), parts[part].end(), all.begin() + offsets[part]);
        std::vector<Item>().swap(parts[part]);
    });
    return all;
}

}  // namespace tracked_mcf
