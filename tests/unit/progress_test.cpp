#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/parallel.h"
#include "filter_tracked_mcf/core/progress_meter.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

using Clock = ProgressMeter::Clock;

/// Evolves with a call of the callback at every poll.
FlowReport evolve_polled(TriangleMesh& mesh, const Selection& selection, const FlowParameters& p,
                         const Progress& progress) {
    ProgressMeter meter(progress, Clock::duration::zero());
    return evolve(mesh, selection, p, meter);
}

/// What a callback was told, and where.
struct Calls {
    std::vector<double> fractions;
    std::vector<std::string> phases;
    std::set<std::thread::id> threads;

    Progress progress() {
        return [this](double fraction, std::string_view phase) {
            fractions.push_back(fraction);
            if (phases.empty() || phases.back() != phase) phases.emplace_back(phase);
            threads.insert(std::this_thread::get_id());
            return true;
        };
    }
};

/// A flow of every kind: what can be asked for besides, and what of the core it takes.
struct Case {
    const char* name;
    TriangleMesh mesh;
    Selection selection;
    FlowParameters parameters;
    Stop stop = Stop::None;
};

std::vector<Case> cases() {
    const TriangleMesh cap = bumpy_cap(4);
    const TriangleMesh sphere = shapes::bumpy_sphere(3);
    Case held{"held boundary", cap, {}, parameters(0, 1e-3, 1)};
    Case selected{"selection", sphere, above(sphere, 0.2), parameters(3, 1e-3, 1)};
    Case rescaled{"rescaled", sphere, {}, parameters(2, 1e-2, 2)};
    rescaled.parameters.rescale = Rescaling::KeepVolume;
    Case paper{"as in the paper", cap, {}, parameters(3, 1e-3, 1)};
    paper.parameters.solver = Solver::OneWCycle;
    paper.parameters.separate_sheets = false;
    paper.parameters.boundary = BoundaryCondition::LockedCells;
    // In the last step, which evolve() itself takes back.
    Case vanishing{"vanishing", sphere, {}, parameters(3, 0.1, 3), Stop::Vanished};
    return {held, selected, rescaled, paper, vanishing};
}

TEST(Progress, CancellingAnywhereLeavesTheMeshAsItWas) {
    for (Case& flow : cases()) {
        SCOPED_TRACE(flow.name);
        flow.parameters.threads = 1;  // so that there are as many calls every time
        TriangleMesh flowed = flow.mesh;
        Calls calls;
        const FlowReport report =
            evolve_polled(flowed, flow.selection, flow.parameters, calls.progress());
        EXPECT_EQ(report.stop, flow.stop);
        ASSERT_FALSE(same_bits(flowed, flow.mesh));
        ASSERT_GT(calls.fractions.size(), 200U);
        for (std::size_t last = 1; last <= calls.fractions.size(); ++last) {
            TriangleMesh stopped = flow.mesh;
            std::size_t made = 0;
            EXPECT_THROW(evolve_polled(stopped, flow.selection, flow.parameters,
                                       [&](double, std::string_view) { return ++made < last; }),
                         Cancelled);
            EXPECT_EQ(made, last) << "called again";
            EXPECT_TRUE(same_bits(stopped, flow.mesh)) << last;
        }
        TriangleMesh again = flow.mesh;
        evolve(again, flow.selection, flow.parameters);
        EXPECT_TRUE(same_bits(again, flowed));
    }
}

TEST(Progress, ResultsAreTheSameBitsWithAndWithoutIt) {
    for (Case& flow : cases()) {
        SCOPED_TRACE(flow.name);
        TriangleMesh without = flow.mesh;
        evolve(without, flow.selection, flow.parameters);
        for (const int threads : {1, 2, 3}) {
            flow.parameters.threads = threads;
            TriangleMesh with = flow.mesh;
            evolve_polled(with, flow.selection, flow.parameters, Calls().progress());
            EXPECT_TRUE(same_bits(with, without)) << threads;
        }
    }
}

TEST(Progress, ComesFromTheCallingThreadAndRisesFromZeroToOne) {
    for (const int threads : {1, 2, 3}) {
        TriangleMesh mesh = shapes::bumpy_sphere(40);  // more than one block of everything
        FlowParameters p = parameters(0, 1e-3, 2);
        p.threads = threads;
        Calls calls;
        evolve_polled(mesh, {}, p, calls.progress());
        EXPECT_EQ(calls.threads, std::set<std::thread::id>{std::this_thread::get_id()});
        EXPECT_EQ(calls.fractions.front(), 0);
        EXPECT_EQ(calls.fractions.back(), 1);
        EXPECT_TRUE(std::is_sorted(calls.fractions.begin(), calls.fractions.end()));
        EXPECT_EQ(std::count(calls.fractions.begin(), calls.fractions.end(), 1), 1);
        // Steps tell of the solver's iterations, too.
        const std::set<double> different(calls.fractions.begin(), calls.fractions.end());
        EXPECT_GT(different.size(), calls.phases.size() + 2);
    }
}

TEST(Progress, NamesWhatIsBeingDone) {
    TriangleMesh mesh = shapes::bumpy_sphere(5);
    FlowParameters p = parameters(0, 1e-3, 2);
    p.rescale = Rescaling::KeepArea;
    Calls calls;
    evolve(mesh, p, calls.progress());
    const std::vector<std::string> expected = {
        "Checking the mesh",    "Measuring the surface",       "Finding the edges",
        "Choosing the grid",    "Clipping triangles to cells", "Building the octree",
        "Sampling the surface", "Preparing the solver",        "Step 1 of 2",
        "Step 2 of 2",          "Moving the vertices",         "Done"};
    EXPECT_EQ(calls.phases, expected);
}

TEST(Progress, PassesOnWhatTheCallbackThrows) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    for (const int threads : {1, 2, 3}) {
        FlowParameters p = parameters(5, 1e-3, 1);
        p.threads = threads;
        for (const int last : {1, 10, 100, 500}) {
            TriangleMesh stopped = mesh;
            int made = 0;
            const auto fail = [&](double, std::string_view) {
                if (++made >= last) throw std::out_of_range("of the caller's own");
                return true;
            };
            try {
                evolve_polled(stopped, {}, p, fail);
                ADD_FAILURE() << "not thrown";
            } catch (const std::out_of_range& error) {
                EXPECT_STREQ(error.what(), "of the caller's own");
            }
            EXPECT_EQ(made, last);
            EXPECT_TRUE(same_bits(stopped, mesh));
        }
    }
}

TEST(Progress, OfAFlowWithinACallbackIsItsOwn) {
    const TriangleMesh mesh = shapes::bumpy_sphere(5);
    const FlowParameters p = parameters(3, 1e-3, 1);
    const TriangleMesh alone = evolved(mesh, p);
    int outer = 0;
    int inside = 0;
    Calls inner;
    TriangleMesh flowing = mesh;
    evolve_polled(flowing, {}, p, [&](double, std::string_view) {
        EXPECT_EQ(inside, 0) << "called from inside itself";
        if (++outer % 100 != 0) return true;
        ++inside;
        EXPECT_TRUE(same_bits(evolved(mesh, p), alone));  // with no callback
        TriangleMesh other = mesh;
        inner = Calls();
        evolve_polled(other, {}, p, inner.progress());
        EXPECT_TRUE(same_bits(other, alone));
        --inside;
        return true;
    });
    EXPECT_TRUE(same_bits(flowing, alone));
    EXPECT_GT(outer, 200);
    EXPECT_EQ(inner.fractions.back(), 1);
}

TEST(ProgressMeter, IsOfItsThreadAndOfItsTime) {
    int first = 0;
    int second = 0;
    const Progress count_first = [&](double, std::string_view) { return ++first > 0; };
    const Progress count_second = [&](double, std::string_view) { return ++second > 0; };
    const Progress nothing;
    poll_progress();  // without a meter
    {
        const ProgressMeter outer(count_first, Clock::duration::zero());
        poll_progress();
        std::thread(poll_progress).join();
        EXPECT_EQ(first, 1);
        {
            const ProgressMeter inner(count_second, Clock::duration::zero());
            poll_progress();
        }
        {
            const ProgressMeter silent(nothing, Clock::duration::zero());
            poll_progress();
        }
        EXPECT_EQ(std::make_pair(first, second), std::make_pair(1, 1));
        poll_progress();
        EXPECT_EQ(first, 2);
    }
    poll_progress();
    EXPECT_EQ(first, 2);
}

TEST(ProgressMeter, WaitsForItsIntervalBetweenPolls) {
    int calls = 0;
    const Progress progress = [&](double, std::string_view) { return ++calls > 0; };
    const ProgressMeter meter(progress, std::chrono::milliseconds(20));
    const auto start = Clock::now();
    while (calls < 3) poll_progress();
    EXPECT_GE(Clock::now() - start, std::chrono::milliseconds(60));
    enter_phase(0.5, "at once");
    EXPECT_EQ(calls, 4);
}

TEST(ProgressMeter, SpansAreSharesOfSpansAndNothingIsTakenBack) {
    Calls calls;
    const Progress progress = calls.progress();
    const ProgressMeter meter(progress);
    enter_phase(0.25, "a");
    {
        const ProgressSpan half(0.5, 1);
        enter_phase(0.25, "b");
        {
            const ProgressSpan quarter(0.5, 1);
            enter_phase(0.5, "c");
            enter_phase(0, "d");
            enter_phase(std::nan(""), "e");
        }
        enter_phase(0, "f");
    }
    enter_phase(7, "g");
    const std::vector<double> expected = {0.25, 0.625, 0.875, 0.875, 0.875, 1, 1};
    EXPECT_EQ(calls.fractions, expected);
}

TEST(ParallelFor, LeavesOutTheRestAfterAnException) {
    for (const int threads : {1, 3}) {
        const ThreadCountScope scope(threads);
        std::atomic<int> done{0};
        EXPECT_THROW(parallel_for(1000000,
                                  [&](std::int64_t i) {
                                      if (i == 10) throw std::length_error("enough");
                                      ++done;
                                  }),
                     std::length_error);
        EXPECT_LT(done, 1000000 - 1);
        if (threads == 1) {
            EXPECT_EQ(done, 10);
        }
    }
}

TEST(ParallelFor, GivesEveryThreadAWorkspaceOfItsOwn) {
    const ThreadCountScope scope(3);
    constexpr std::int64_t count = 20 * kBlockSize + 1;
    std::atomic<int> made{0};
    std::vector<int> visits(count, 0);
    parallel_for_blocks_with(
        count,
        [&] {
            ++made;
            return std::vector<std::int64_t>(1, -1);
        },
        [&](std::vector<std::int64_t>& workspace, std::int64_t begin, std::int64_t end) {
            for (std::int64_t i = begin; i < end; ++i) {
                workspace[0] = i;
                ++visits[i];
                EXPECT_EQ(workspace[0], i);
            }
        });
    EXPECT_LE(made, 3);
    EXPECT_GE(made, 1);
    EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](int n) { return n == 1; }));
}

}  // namespace
}  // namespace tracked_mcf
