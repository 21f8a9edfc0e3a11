// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace tracked_mcf {

/// The threads that share the parallel loops of one thread, the *owner*: the thread that constructs
/// the team, for as long as the team lives. Loops of a thread without a team run in that thread
/// alone, and so do loops inside the body of another loop.
///
/// Threads without an item sleep, so they take no processor from anyone. The owner runs items too,
/// and waits only for threads that have taken one: if another program keeps a thread from running,
/// the others run its share. Since a team lives no longer than its flow, a process that forks or
/// unloads this library between flows has no threads to lose.
class ThreadTeam {
public:
    /// Runs one item. `member`, below size(), differs between items that run at the same time.
    using Body = std::function<void(std::int64_t item, std::size_t member)>;

    /// `size` counts the owner, too; 0 takes default_size(). A thread starts when a loop first
    /// needs it; if the system refuses to start it, the team stays smaller.
    explicit ThreadTeam(int size);
    ~ThreadTeam();
    ThreadTeam(const ThreadTeam&) = delete;
    ThreadTeam& operator=(const ThreadTeam&) = delete;

    /// Returns OMP_NUM_THREADS if it is set, as pools set it for their workers, else the number of
    /// processors that this process may use.
    static int default_size();

    /// Returns the size of the calling thread's team, or 1 if it has none.
    static std::size_t size();

    /// Runs all items in [0, count), in any order, on the calling thread's team if there are at
    /// least `worth_threads` items. After the first exception, skips the remaining items and
    /// rethrows it. Each thread polls progress before each item, but only the calling thread can
    /// have a meter.
    static void run(std::int64_t count, const Body& body, std::int64_t worth_threads = 2);

private:
    struct Loop;

    void start_threads(std::int64_t items);
    void run_with_threads(Loop& loop);
    void run_items(Loop& loop, std::size_t member);
    void serve();

    const std::size_t size_;
    ThreadTeam* const hidden_;  ///< the owner's team before this one
    std::vector<std::thread> threads_;

    std::mutex mutex_;
    // Guarded by the mutex, as are the members of a loop.
    Loop* loop_ = nullptr;  ///< the loop that threads may join
    bool ends_ = false;
    std::condition_variable has_items_;  ///< or ends_ is true
    std::condition_variable is_done_;    ///< no thread runs an item of the last loop
};

}  // namespace tracked_mcf
