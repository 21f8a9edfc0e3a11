#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <numeric>
#include <vector>

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

/// Slices to cut a loop into, so that the threads there are finish at about the same time.
std::int64_t slice_count();

/// Calls body(i) for every i in [0, count), in any order and, from `worth_threads` of them on, in
/// parallel. An exception of a body is thrown on after the loop; it must not leave an OpenMP region
/// by itself.
template <class Body>
void parallel_for(std::int64_t count, const Body& body, std::int64_t worth_threads = 2) {
    std::exception_ptr failure;
#pragma omp parallel for schedule(dynamic, 1) if (count >= worth_threads)
    for (std::int64_t i = 0; i < count; ++i) {
        try {
            body(i);
        } catch (...) {
#pragma omp critical(tracked_mcf_parallel_for)
            failure = std::current_exception();
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

/// Calls body(begin, end) for a few slices that cover [0, count), in parallel, for bodies that need
/// a large workspace of their own. How many depends on the number of threads, so the results must
/// not depend on where a slice begins.
template <class Body>
void parallel_for_slices(std::int64_t count, const Body& body) {
    const std::int64_t slices = std::min<std::int64_t>(count, slice_count());
    parallel_for(slices, [&](std::int64_t slice) {
        body(count * slice / slices, count * (slice + 1) / slices);
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
    std::vector<Item> all(offsets.back());
    parallel_for(static_cast<std::int64_t>(parts.size()), [&](std::int64_t part) {
        std::copy(parts[part].begin(), parts[part].end(), all.begin() + offsets[part]);
        std::vector<Item>().swap(parts[part]);
    });
    return all;
}

}  // namespace tracked_mcf
