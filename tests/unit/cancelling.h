// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <limits>
#include <string_view>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/progress.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {

/// Expects that a filter reports progress that never decreases and ends at 1, and that it leaves
/// the mesh as it was if it is cancelled at any of these calls. `filter` takes a mesh and a
/// Progress.
template <class Filter>
void expect_unchanged_if_cancelled(const TriangleMesh& before, const Filter& filter) {
    const auto run = [&](int last_call) {
        TriangleMesh mesh = before;
        int calls = 0;
        double done = 0;
        const Progress progress = [&](double fraction, std::string_view /*phase*/) {
            EXPECT_GE(fraction, done);
            done = fraction;
            return ++calls < last_call;
        };
        try {
            filter(mesh, progress);
            EXPECT_EQ(done, 1);
            return calls;
        } catch (const Cancelled&) {
            EXPECT_EQ(calls, last_call);
        }
        EXPECT_TRUE(same_bits(mesh, before));
        return 0;
    };
    const int calls = run(std::numeric_limits<int>::max());
    EXPECT_GE(calls, 3);
    for (int call = 1; call <= calls; ++call) run(call);
}

}  // namespace tracked_mcf
