// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/plan/memory_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/memory/process_memory.h"
#include "tests/support/elements.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

using ::testing::HasSubstr;

FlowParameters of_grid() {
    FlowParameters p;
    p.solver = Solver::Grid;
    return p;
}

class CheckOfASphere : public ::testing::Test {
protected:
    MemoryCheck with(std::int64_t available) const {
        return {size_, enclosing_grid(mesh_, 0), parameters_, available};
    }

    /// Returns the message that refuses a flow at this depth, or "" if it fits.
    std::string refusal(int depth, std::int64_t available) const {
        try {
            with(available).before_flow(depth);
        } catch (const NotEnoughMemory& error) {
            return error.what();
        }
        return {};
    }

    const TriangleMesh mesh_ = shapes::geodesic_sphere(20);
    const FlowParameters parameters_ = of_grid();
    const SurfaceSize size_ = size_of(Domain(mesh_, parameters_.boundary));
};

TEST_F(CheckOfASphere, AllowsWhatFitsAndEverythingIfTheMemoryIsUnknown) {
    const auto needed = static_cast<std::int64_t>(std::ceil(with(0).flow_bytes(8)));
    EXPECT_EQ(refusal(8, needed), "");
    EXPECT_EQ(refusal(8, 0), "");
    EXPECT_NE(refusal(8, needed - 1), "");
}

TEST_F(CheckOfASphere, NamesTheLargestDepthThatFits) {
    const auto enough_for_9 = static_cast<std::int64_t>(1.01 * with(0).flow_bytes(9));
    const std::string message = refusal(12, enough_for_9);
    EXPECT_TRUE(std::regex_match(
        message, std::regex("Depth 12 would need about [0-9]+ GB of memory, but only [0-9.]+ GB "
                            "are free. Choose depth 9 or less, which needs about [0-9.]+ GB, or "
                            "smooth a simplified mesh or a part of it.")))
        << message;
    EXPECT_EQ(refusal(9, enough_for_9), "");
}

TEST_F(CheckOfASphere, SaysThatNoDepthFits) {
    EXPECT_THAT(refusal(10, 1000),
                HasSubstr("No depth would fit: smooth a simplified mesh, or a part of it."));
    EXPECT_THAT(refusal(1, 1000), HasSubstr("No depth would fit"));
}

TEST_F(CheckOfASphere, ClippingNeedsLess) {
    const MemoryCheck check = with(static_cast<std::int64_t>(with(0).flow_bytes(9) / 2));
    EXPECT_NO_THROW(check.before_clipping(9));
    EXPECT_THROW(check.before_clipping(12), NotEnoughMemory);
}

TEST_F(CheckOfASphere, RefusesToClipAtTheAutomaticDepth) {
    EXPECT_NO_THROW(automatic_depth(mesh_));
    EXPECT_THROW(automatic_depth(mesh_, 0, 1000), NotEnoughMemory);
}

TEST(AvailableMemory, IsKnown) {
#ifdef __APPLE__
    GTEST_SKIP() << "macOS does not say how much memory is available";
#endif
    EXPECT_GT(available_memory_bytes(), 1);
    const std::int64_t resident = resident_memory_bytes();  // before the peak, which may rise
    EXPECT_GT(resident, 0);
    EXPECT_GE(peak_memory_bytes(), resident);
}

TEST(NotEnoughMemory, IsThrownForMoreThanAnyMachineHas) {
    if (available_memory_bytes() == 0) GTEST_SKIP() << "the system does not report memory";
    const TriangleMesh mesh = shapes::stack(shapes::square(9), 500, 1e-6);
    TriangleMesh after = mesh;
    FlowParameters p = parameters(12, 1e-3, 1);
    p.solver = Solver::Grid;
    EXPECT_THROW(evolve(after, p), NotEnoughMemory);
    EXPECT_TRUE(same_bits(after, mesh));
}

TEST(NotEnoughMemory, NamesTheTaskTheNeedAndWhatToDo) {
    check_free_memory(1, "This", "");
    try {
        check_free_memory(1e18, "Removing noise", "Simplify the mesh.");
        ADD_FAILURE() << "not thrown";
    } catch (const NotEnoughMemory& error) {
        EXPECT_THAT(error.what(), testing::MatchesRegex("Removing noise would need about .* of "
                                                        "memory, but only .* are free. Simplify "
                                                        "the mesh."));
    }
}

}  // namespace
}  // namespace tracked_mcf
