// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <thread>
#include <vector>

namespace tracked_mcf {

/// Runs body(thread) in `count` threads that start together, so that they meet even on few cores.
template <class Body>
void at_once(std::size_t count, const Body& body) {
    std::atomic<std::size_t> waiting{count};
    std::vector<std::thread> threads;
    threads.reserve(count);
    for (std::size_t thread = 0; thread < count; ++thread) {
        threads.emplace_back([&, thread] {
            --waiting;
            while (waiting > 0) std::this_thread::yield();
            body(thread);
        });
    }
    for (std::thread& thread : threads) thread.join();
}

}  // namespace tracked_mcf
