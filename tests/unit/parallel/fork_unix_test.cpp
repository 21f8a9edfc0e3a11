// SPDX-License-Identifier: GPL-3.0-or-later
/// A process that has run parallel loops forks, as Python's multiprocessing does on Linux.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {
namespace {

std::int64_t sum_of_squares() {
    const ThreadCountScope threads(2);
    return parallel_sum(100 * kChunkSize, std::int64_t{0},
                        [](std::int64_t begin, std::int64_t end) {
                            std::int64_t sum = 0;
                            for (std::int64_t i = begin; i < end; ++i) sum += i * i;
                            return sum;
                        });
}

TEST(Fork, LoopsOfTheChildEnd) {
    const std::int64_t expected = sum_of_squares();
    const pid_t child = fork();
    if (child == 0) {
        alarm(10);  // Its signal ends a child that hangs.
        std::_Exit(sum_of_squares() == expected ? 0 : 1);
    }
    int status = -1;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
    EXPECT_EQ(WEXITSTATUS(status), 0);
    EXPECT_EQ(sum_of_squares(), expected);
}

}  // namespace
}  // namespace tracked_mcf
