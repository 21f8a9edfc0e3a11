// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
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
#include "filter_tracked_mcf/core/parallel/progress_meter.h"
#include "filter_tracked_mcf/core/remove_noise.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

using Clock = ProgressMeter::Clock;

/// Evolves and invokes the callback at every poll.
FlowReport evolve_polled(TriangleMesh& mesh, const Selection& selection, const FlowParameters& p,
                         const Progress& progress) {
    const ProgressMeter meter(progress, Clock::duration::zero());
    return evolve(mesh, selection, p);
}

/// Records what a callback receives, and in which threads.
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

/// A flow, its options and why it stops.
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
    Case constrained{"constrained boundary", cap, {}, parameters(0, 1e-3, 1)};
    Case selected{"selection", sphere, above(sphere, 0.2), parameters(3, 1e-3, 1)};
    Case area{"area preserved", sphere, {}, parameters(2, 1e-2, 2)};
    area.parameters.preserve = Preserve::Area;
    Case volume{"volume preserved", cap, {}, parameters(2, 1e-2, 2)};
    volume.parameters.preserve = Preserve::Volume;
    Case third_order{"order 3", sphere, {}, parameters(2, 1e-2, 1)};
    third_order.parameters.order = 3;
    Case paper{"as in the paper", cap, {}, parameters(3, 1e-3, 1)};
    paper.parameters.method = Method::Paper;
    // The surface vanishes in the last step, which evolve() itself takes back.
    Case vanishing{"vanishing", sphere, {}, parameters(3, 0.1, 3), Stop::Vanished};
    return {constrained, selected, area, volume, third_order, paper, vanishing};
}

TEST(Progress, CancellingAnywhereLeavesTheMeshAsItWas) {
    for (Case& flow : cases()) {
        SCOPED_TRACE(flow.name);
        flow.parameters.threads = 1;  // so that the number of calls is reproducible
        TriangleMesh flowed = flow.mesh;
        Calls calls;
        const FlowReport report =
            evolve_polled(flowed, flow.selection, flow.parameters, calls.progress());
        EXPECT_EQ(report.stop, flow.stop);
        ASSERT_FALSE(same_bits(flowed, flow.mesh));
        ASSERT_GT(calls.fractions.size(), 100U);
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

TEST(Progress, IsReportedByTheCallingThreadAndRisesFromZeroToOne) {
    for (const int threads : {1, 2, 3}) {
        TriangleMesh mesh =
            shapes::bumpy_sphere(40);  // every parallel loop has more than one chunk
        FlowParameters p = parameters(0, 1e-3, 2);
        p.threads = threads;
        Calls calls;
        evolve_polled(mesh, {}, p, calls.progress());
        EXPECT_EQ(calls.threads, std::set<std::thread::id>{std::this_thread::get_id()});
        EXPECT_EQ(calls.fractions.front(), 0);
        EXPECT_EQ(calls.fractions.back(), 1);
        EXPECT_TRUE(std::is_sorted(calls.fractions.begin(), calls.fractions.end()));
        EXPECT_EQ(std::count(calls.fractions.begin(), calls.fractions.end(), 1), 1);
        // Within a step, the solver's iterations also advance the fraction.
        const std::set<double> different(calls.fractions.begin(), calls.fractions.end());
        EXPECT_GT(different.size(), calls.phases.size() + 2);
    }
}

TEST(Progress, NamesThePhases) {
    TriangleMesh mesh = shapes::bumpy_sphere(5);
    FlowParameters p = parameters(0, 1e-3, 2);
    p.preserve = Preserve::Area;
    Calls calls;
    evolve(mesh, p, calls.progress());
    const std::vector<std::string> expected = {
        "Checking the mesh",   "Finding the edges",    "Measuring the surface",
        "Building the octree", "Preparing the solver", "Step 1 of 2",
        "Step 2 of 2",         "Moving the vertices",  "Done"};
    EXPECT_EQ(calls.phases, expected);
    p = parameters(0, 1e-3, 2);
    p.method = Method::Paper;
    Calls of_paper;
    evolve(mesh, p, of_paper.progress());
    const std::vector<std::string> expected_of_paper = {"Checking the mesh",
                                                        "Finding the edges",
                                                        "Measuring the surface",
                                                        "Clipping triangles to cells",
                                                        "Building the octree",
                                                        "Sampling the surface",
                                                        "Preparing the solver",
                                                        "Step 1 of 2",
                                                        "Step 2 of 2",
                                                        "Moving the vertices",
                                                        "Done"};
    EXPECT_EQ(of_paper.phases, expected_of_paper);
}

TEST(Progress, PassesOnWhatTheCallbackThrows) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    for (const int threads : {1, 2, 3}) {
        FlowParameters p = parameters(5, 1e-3, 1);
        p.threads = threads;
        for (const int last : {1, 10, 100, 300}) {
            TriangleMesh stopped = mesh;
            int made = 0;
            const auto fail = [&](double, std::string_view) {
                if (++made >= last) throw std::out_of_range("thrown by the callback");
                return true;
            };
            try {
                evolve_polled(stopped, {}, p, fail);
                ADD_FAILURE() << "not thrown";
            } catch (const std::out_of_range& error) {
                EXPECT_STREQ(error.what(), "thrown by the callback");
            }
            EXPECT_EQ(made, last);
            EXPECT_TRUE(same_bits(stopped, mesh));
        }
    }
}

TEST(Progress, OfAFlowInsideACallbackGoesToItsOwnCallback) {
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

TEST(Progress, OfAFilterThatAnObserverCallsGoesNowhere) {
    const TriangleMesh mesh = shapes::bumpy_sphere(5);
    const FlowParameters p = parameters(3, 1e-3, 1);
    Calls with, without;
    TriangleMesh flowing = mesh;
    evolve(flowing, {}, p, without.progress(), [](int, const auto&) {});
    flowing = mesh;
    evolve(flowing, {}, p, with.progress(), [&](int, const auto&) {
        TriangleMesh other = mesh;
        remove_noise(other, {}, NoiseParameters());
        evolved(mesh, p);
    });
    EXPECT_EQ(with.phases, without.phases);
}

TEST(ProgressMeter, ServesItsThreadDuringItsLife) {
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

TEST(ProgressMeter, SpansNestAndFractionsNeverDecrease) {
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

}  // namespace
}  // namespace tracked_mcf
