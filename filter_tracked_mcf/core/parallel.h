#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/progress_meter.h"
#include "filter_tracked_mcf/core/raw_vector.h"

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

/// Calls body(item) for the items of a vector, in parallel where there are enough of them.
template <class Items, class Body>
void parallel_for_items(const Items& items, const Body& body) {
    parallel_for_rows(static_cast<std::int64_t>(items.size()),
                      [&](std::int32_t i) { body(items[i]); });
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

/// The first i in [begin, end) that begins(i), or the end.
template <class Begins>
std::int64_t next_run(std::int64_t begin, std::int64_t end, const Begins& begins) {
    while (begin < end && !begins(begin)) ++begin;
    return begin;
}

/// Calls body(begin, end) for ranges that cover [0, count), in parallel. They are blocks, but for
/// runs of items, which stay together: only the first item of each `begins`.
template <class Begins, class Body>
void parallel_for_runs(std::int64_t count, const Begins& begins, const Body& body) {
    parallel_for_blocks(count, [&](std::int64_t block_begin, std::int64_t block_end) {
        const std::int64_t begin = next_run(block_begin, block_end, begins);
        if (begin < block_end) body(begin, next_run(block_end, count, begins));
    });
}

/// Calls body(first, last) for every run in [begin, end), the first item of which `begins`.
template <class Begins, class Body>
void for_each_run(std::int64_t begin, std::int64_t end, const Begins& begins, const Body& body) {
    for (std::int64_t first = begin, last = begin; first < end; first = last) {
        ++last;
        while (last < end && !begins(last)) ++last;
        body(first, last);
    }
}

/// begin[i] becomes the sum of size(j) over all j < i, for i from 0 to `count`.
template <class Number, class Allocator, class Size>
void parallel_add_up(std::int64_t count, const Size& size, std::vector<Number, Allocator>& begin) {
    std::vector<Number> sums(static_cast<std::size_t>(block_count(count)));
    parallel_for_blocks(count, [&](std::int64_t first, std::int64_t last) {
        Number sum = 0;
        for (std::int64_t i = first; i < last; ++i) sum += static_cast<Number>(size(i));
        sums[first / kBlockSize] = sum;
    });
    Number total = 0;
    for (Number& sum : sums) total += std::exchange(sum, total);
    begin.resize(static_cast<std::size_t>(count) + 1);
    parallel_for_blocks(count, [&](std::int64_t first, std::int64_t last) {
        Number sum = sums[first / kBlockSize];
        for (std::int64_t i = first; i < last; ++i) {
            begin[i] = sum;
            sum += static_cast<Number>(size(i));
        }
    });
    begin[count] = total;
}

/// How many i in [0, count) are `counted`(i).
template <class Counted>
std::int64_t parallel_count(std::int64_t count, const Counted& counted) {
    return parallel_sum(count, std::int64_t{0}, [&](std::int64_t begin, std::int64_t end) {
        std::int64_t here = 0;
        for (std::int64_t i = begin; i < end; ++i) here += counted(i) ? 1 : 0;
        return here;
    });
}

/// Calls body(begin, end, before) for the blocks that cover [0, count), in parallel; `before` is
/// how many items i before the block are `counted`(i). Returns how many are in all.
template <class Counted, class Body>
std::int64_t number_blocks(std::int64_t count, const Counted& counted, const Body& body) {
    std::vector<std::int64_t> before(static_cast<std::size_t>(block_count(count)));
    parallel_for_blocks(count, [&](std::int64_t begin, std::int64_t end) {
        std::int64_t here = 0;
        for (std::int64_t i = begin; i < end; ++i) here += counted(i) ? 1 : 0;
        before[begin / kBlockSize] = here;
    });
    std::int64_t total = 0;
    for (std::int64_t& number : before) total += std::exchange(number, total);
    parallel_for_blocks(count, [&](std::int64_t begin, std::int64_t end) {
        body(begin, end, before[begin / kBlockSize]);
    });
    return total;
}

/// Calls body(begin, end, out) for the blocks that cover [0, count), in parallel; each appends to
/// `out`, which is empty. Returns all that was appended, in the order of the blocks.
template <class Item, class Items = std::vector<Item>, class Body>
Items parallel_collect(std::int64_t count, const Body& body) {
    std::vector<std::vector<Item>> parts(static_cast<std::size_t>(block_count(count)));
    // A part has no more room than it needs: there may be as much in all as memory has.
    parallel_for_blocks_with(
        count, [] { return std::vector<Item>(); },
        [&](std::vector<Item>& part, std::int64_t begin, std::int64_t end) {
            part.clear();
            body(begin, end, part);
            parts[begin / kBlockSize].assign(part.begin(), part.end());
        });
    std::vector<std::size_t> offsets(parts.size() + 1, 0);
    for (std::size_t part = 0; part < parts.size(); ++part) {
        offsets[part + 1] = offsets[part] + parts[part].size();
    }
    Items all;
    resize(all, static_cast<std::int64_t>(offsets.back()));
    parallel_for(static_cast<std::int64_t>(parts.size()), [&](std::int64_t part) {
        std::copy(parts[part].begin(), parts[part].end(), all.begin() + offsets[part]);
        std::vector<Item>().swap(parts[part]);
    });
    return all;
}

/// The same for ranges that do not cut runs in two, see parallel_for_runs.
template <class Item, class Items, class Begins, class Body>
Items parallel_collect_runs(std::int64_t count, const Begins& begins, const Body& body) {
    return parallel_collect<Item, Items>(
        count, [&](std::int64_t block_begin, std::int64_t block_end, std::vector<Item>& out) {
            const std::int64_t begin = next_run(block_begin, block_end, begins);
            if (begin < block_end) body(begin, next_run(block_end, count, begins), out);
        });
}

}  // namespace tracked_mcf
