// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/parallel/progress_meter.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"
#include "filter_tracked_mcf/core/parallel/thread_team.h"

/// Parallel loops over the items of a mesh. All of them poll progress (progress_meter.h) at every
/// chunk, and give the same bits for any number of threads.
namespace tracked_mcf {

/// Calls body(i) for every i in [0, count), in any order, and in parallel if `count` is at least
/// `worth_threads`. See ThreadTeam::run().
template <class Body>
void parallel_for(std::int64_t count, const Body& body, std::int64_t worth_threads = 2) {
    const auto run_item = [&](std::int64_t i, std::size_t /*member*/) { body(i); };
    ThreadTeam::run(count, std::cref(run_item), worth_threads);
}

/// Items of a chunk. The size does not depend on the number of threads, so sums and lists that are
/// joined in the order of the chunks have the same bits for any number of threads.
inline constexpr std::int64_t kChunkSize = 1024;

inline std::int64_t chunk_count(std::int64_t count) {
    return (count + kChunkSize - 1) / kChunkSize;
}

/// Calls body(begin, end) for consecutive chunks that cover [0, count), in parallel.
template <class Body>
void parallel_for_chunks(std::int64_t count, const Body& body) {
    parallel_for(chunk_count(count), [&](std::int64_t chunk) {
        body(chunk * kChunkSize, std::min(count, (chunk + 1) * kChunkSize));
    });
}

/// Chunks of light work that outweigh waking and joining threads.
inline constexpr std::int64_t kChunksWorthThreads = 16;

/// Calls body(row) for every row in [0, count), in parallel if there are many. For light bodies.
template <class Body>
void parallel_for_rows(std::int64_t count, const Body& body) {
    parallel_for(
        chunk_count(count),
        [&](std::int64_t chunk) {
            const auto end = static_cast<std::int32_t>(std::min(count, (chunk + 1) * kChunkSize));
            for (auto row = static_cast<std::int32_t>(chunk * kChunkSize); row < end; ++row) {
                body(row);
            }
        },
        kChunksWorthThreads);
}

/// Calls body(item) for every item of a vector, in parallel if there are many. For light bodies.
template <class Items, class Body>
void parallel_for_items(const Items& items, const Body& body) {
    parallel_for_rows(static_cast<std::int64_t>(items.size()),
                      [&](std::int32_t i) { body(items[i]); });
}

/// Calls body(workspace, begin, end) for consecutive chunks that cover [0, count), in parallel.
/// make() returns a workspace, one for each thread that gets a chunk. Results must not depend on
/// the chunks that used a workspace before.
template <class Make, class Body>
void parallel_for_chunks_with(std::int64_t count, const Make& make, const Body& body) {
    std::vector<std::optional<decltype(make())>> workspaces(ThreadTeam::size());
    const auto run_chunk = [&](std::int64_t chunk, std::size_t member) {
        auto& workspace = workspaces[member];
        if (!workspace) workspace.emplace(make());
        body(*workspace, chunk * kChunkSize, std::min(count, (chunk + 1) * kChunkSize));
    };
    ThreadTeam::run(chunk_count(count), std::cref(run_chunk));
}

/// Returns `zero` plus body(begin, end) of the chunks that cover [0, count), added in their order.
template <class Value, class Body>
Value parallel_sum(std::int64_t count, const Value& zero, const Body& body) {
    std::vector<Value> sums(static_cast<std::size_t>(chunk_count(count)));
    parallel_for_chunks(count, [&](std::int64_t begin, std::int64_t end) {
        sums[begin / kChunkSize] = body(begin, end);
    });
    return std::accumulate(sums.begin(), sums.end(), zero);
}

/// Returns the sum of size(i) over each of the chunks that cover [0, count).
template <class Number, class Size>
std::vector<Number> chunk_sums(std::int64_t count, const Size& size) {
    std::vector<Number> sums(static_cast<std::size_t>(chunk_count(count)), 0);
    parallel_for_chunks(count, [&](std::int64_t begin, std::int64_t end) {
        Number sum = 0;
        for (std::int64_t i = begin; i < end; ++i) sum += static_cast<Number>(size(i));
        sums[begin / kChunkSize] = sum;
    });
    return sums;
}

/// Returns how many i in [0, count) satisfy counted(i).
template <class Counted>
std::int64_t parallel_count(std::int64_t count, const Counted& counted) {
    const auto sums = chunk_sums<std::int64_t>(count, counted);
    return std::accumulate(sums.begin(), sums.end(), std::int64_t{0});
}

/// Calls body(begin, end, sum) for consecutive chunks that cover [0, count), in parallel; `sum` is
/// the exclusive prefix sum of size(i) at `begin`. Returns the sum over all i.
template <class Number, class Size, class Body>
Number parallel_scan(std::int64_t count, const Size& size, const Body& body) {
    std::vector<Number> sums = chunk_sums<Number>(count, size);
    Number total = 0;
    for (Number& sum : sums) total += std::exchange(sum, total);
    parallel_for_chunks(count, [&](std::int64_t begin, std::int64_t end) {
        body(begin, end, sums[begin / kChunkSize]);
    });
    return total;
}

/// Sets offsets[i], for i in [0, count], to the exclusive prefix sum: the sum of size(j) over j <
/// i.
template <class Number, class Allocator, class Size>
void parallel_prefix_sum(std::int64_t count, const Size& size,
                         std::vector<Number, Allocator>& offsets) {
    offsets.resize(static_cast<std::size_t>(count) + 1);
    offsets[count] =
        parallel_scan<Number>(count, size, [&](std::int64_t begin, std::int64_t end, Number sum) {
            for (std::int64_t i = begin; i < end; ++i) {
                offsets[i] = sum;
                sum += static_cast<Number>(size(i));
            }
        });
}

/// Returns the function that tells whether item i is the first of a run: the first item of all, or
/// one whose key differs from that of the item before. The loops over runs below call it `begins`.
/// `items` must outlive the function.
template <class Items, class Key>
auto runs_by(const Items& items, Key key) {
    return [&items, key](std::int64_t i) { return i == 0 || key(items[i]) != key(items[i - 1]); };
}

/// Returns the first i in [begin, end) that satisfies begins(i), or `end`.
template <class Begins>
std::int64_t next_run(std::int64_t begin, std::int64_t end, const Begins& begins) {
    while (begin < end && !begins(begin)) ++begin;
    return begin;
}

/// Returns, for each chunk of [0, count) and for the end, the first item from there on that begins
/// a run. Between two of these offsets are whole runs, about a chunk of items.
template <class Begins>
std::vector<std::int64_t> run_offsets(std::int64_t count, const Begins& begins) {
    std::vector<std::int64_t> offsets(static_cast<std::size_t>(chunk_count(count)) + 1, count);
    parallel_for_chunks(count, [&](std::int64_t begin, std::int64_t end) {
        offsets[begin / kChunkSize] = next_run(begin, end, begins);
    });
    for (std::int64_t chunk = chunk_count(count) - 1; chunk >= 0; --chunk) {
        const bool has_begin = offsets[chunk] < (chunk + 1) * kChunkSize;
        if (!has_begin) offsets[chunk] = offsets[chunk + 1];
    }
    return offsets;
}

/// Calls body(begin, end) for ranges of whole runs that cover [0, count), in parallel; begins(i)
/// says whether a run begins at item i. A body may change the items of its range: all ranges are
/// known before the first body runs.
template <class Begins, class Body>
void parallel_for_runs(std::int64_t count, const Begins& begins, const Body& body) {
    const std::vector<std::int64_t> offsets = run_offsets(count, begins);
    parallel_for(chunk_count(count), [&](std::int64_t chunk) {
        if (offsets[chunk] < offsets[chunk + 1]) body(offsets[chunk], offsets[chunk + 1]);
    });
}

/// Calls body(first, last) for every run in [begin, end), in order.
template <class Begins, class Body>
void for_each_run(std::int64_t begin, std::int64_t end, const Begins& begins, const Body& body) {
    for (std::int64_t first = begin, last = begin; first < end; first = last) {
        last = next_run(first + 1, end, begins);
        body(first, last);
    }
}

/// Calls body(begin, end, out) for consecutive chunks that cover [0, count), in parallel; body
/// appends to `out`, which starts empty. Returns all appended items in the order of the chunks.
template <class Item, class Items = std::vector<Item>, class Body>
Items parallel_collect(std::int64_t count, const Body& body) {
    std::vector<std::vector<Item>> lists(static_cast<std::size_t>(chunk_count(count)));
    // Each list is copied to exactly its size: together the lists may take most of the memory.
    parallel_for_chunks_with(
        count, [] { return std::vector<Item>(); },
        [&](std::vector<Item>& list, std::int64_t begin, std::int64_t end) {
            list.clear();
            body(begin, end, list);
            lists[begin / kChunkSize].assign(list.begin(), list.end());
        });
    const auto list_count = static_cast<std::int64_t>(lists.size());
    std::vector<std::size_t> offsets;
    parallel_prefix_sum(
        list_count, [&](std::int64_t list) { return lists[list].size(); }, offsets);
    Items all(offsets.back());
    parallel_for(list_count, [&](std::int64_t list) {
        std::copy(lists[list].begin(), lists[list].end(), all.begin() + offsets[list]);
        std::vector<Item>().swap(lists[list]);
    });
    return all;
}

/// Returns value(i) for every i in [0, count) with chosen(i), in increasing order of i.
template <class Item, class Items = std::vector<Item>, class Chosen, class Value>
Items parallel_collect_if(std::int64_t count, const Chosen& chosen, const Value& value) {
    return parallel_collect<Item, Items>(
        count, [&](std::int64_t begin, std::int64_t end, std::vector<Item>& out) {
            for (std::int64_t i = begin; i < end; ++i) {
                if (chosen(i)) out.push_back(value(i));
            }
        });
}

}  // namespace tracked_mcf
