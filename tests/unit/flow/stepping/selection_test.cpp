// SPDX-License-Identifier: GPL-3.0-or-later
// The selected faces flow as a mesh of their own with a locked boundary.

#include <gtest/gtest.h>

#include <algorithm>

#include "filter_tracked_mcf/core/flow/plan/plan.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

/// Returns for each vertex whether an unselected triangle has it, so that it must keep its bits.
std::vector<bool> must_stay(const TriangleMesh& mesh, const Selection& selection) {
    std::vector<bool> stays(mesh.positions.size(), false);
    for (std::size_t i = 0; i < selection.size(); ++i) {
        if (selection[i] != 0) continue;
        for (const std::int32_t vertex : mesh.triangles[i]) stays[vertex] = true;
    }
    return stays;
}

TEST(Selection, UnselectedVerticesKeepTheirBitsAndTheOthersMove) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    const Selection top = above(mesh, 0.3);
    const std::vector<bool> stays = must_stay(mesh, top);
    for (const auto boundary : {BoundaryCondition::Locked, BoundaryCondition::Free}) {
        FlowParameters p = parameters(6, 1e-3, 3);
        p.boundary = boundary;
        TriangleMesh after = mesh;
        const FlowReport report = evolve(after, top, p);
        int moved = 0;
        for (std::size_t i = 0; i < stays.size(); ++i) {
            const bool same = same_bits(after.positions[i], mesh.positions[i]);
            EXPECT_TRUE(same || !stays[i]) << i;
            moved += same ? 0 : 1;
        }
        EXPECT_GT(moved, 300);
        EXPECT_GT(report.held_vertices, 20);
        EXPECT_EQ(report.triangles, std::count(top.begin(), top.end(), 1));
        EXPECT_EQ(report.unselected_triangles, std::count(top.begin(), top.end(), 0));
    }
}

TEST(Selection, OfASmallPartFlowsAsThatPartAlone) {
    // The same depth, detail size and positions: the grid encloses the selected faces only.
    const TriangleMesh mesh = shapes::bumpy_sphere(40);
    const Selection tip = above(mesh, 0.95);
    const TriangleMesh part = part_of(mesh, tip);
    EXPECT_LT(20 * part.triangles.size(), mesh.triangles.size());
    for (const double step_size : {0.0, 1e-4}) {
        FlowParameters p = parameters(0, step_size, 3);
        TriangleMesh selected = mesh, alone = part;
        const FlowReport of_selection = evolve(selected, tip, p);
        const FlowReport of_part = evolve(alone, p);
        EXPECT_EQ(of_selection.depth, of_part.depth);
        EXPECT_EQ(of_selection.cell_size, of_part.cell_size);
        EXPECT_EQ(of_selection.unknowns, of_part.unknowns);
        EXPECT_EQ(of_selection.detail_size, of_part.detail_size);
        EXPECT_TRUE(same_bits(selected, alone));
        EXPECT_GT(of_selection.largest_displacement, 1e-4);
    }
}

TEST(Selection, RelativeStepSizeIsThatOfTheWholeMesh) {
    const TriangleMesh mesh = shapes::bumpy_sphere(30);
    const Selection top = above(mesh, 0.8);
    TriangleMesh whole = mesh, part = mesh;
    const FlowReport of_whole = evolve(whole, parameters(7, 1e-4, 1));
    const FlowReport of_part = evolve(part, top, parameters(7, 1e-4, 1));
    EXPECT_NEAR(of_part.step_size, of_whole.step_size, 1e-14);
    EXPECT_LT(of_part.cell_size, of_whole.cell_size);
    // Away from the seam, the selected part moves as in the flow of the whole mesh: as closely as
    // that flow agrees with itself on a grid of half the cell size, up to a factor of 2.
    const TriangleMesh finer = evolved(mesh, parameters(8, 1e-4, 1));
    double difference = 0, of_depth = 0, moved = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (mesh.positions[i][2] < 1) continue;
        difference += (part.positions[i] - whole.positions[i]).squaredNorm();
        of_depth += (finer.positions[i] - whole.positions[i]).squaredNorm();
        moved += (whole.positions[i] - mesh.positions[i]).squaredNorm();
    }
    EXPECT_LT(difference, 4 * of_depth);
    EXPECT_LT(of_depth, 0.01 * moved);
}

TEST(Selection, SurfaceIsContinuousAtTheSeam) {
    // Vertices next to the seam move by less than a fifth of the largest movement.
    const TriangleMesh mesh = shapes::bumpy_sphere(40);
    const Selection top = above(mesh, 0.3);
    const std::vector<bool> stays = must_stay(mesh, top);
    TriangleMesh after = mesh;
    evolve(after, top, parameters(5, 1e-2, 3));
    double beside = 0, anywhere = 0;
    for (std::size_t i = 0; i < top.size(); ++i) {
        if (top[i] == 0) continue;
        const Triangle& t = mesh.triangles[i];
        const bool at_seam = stays[t[0]] || stays[t[1]] || stays[t[2]];
        for (const std::int32_t vertex : t) {
            const double moved = (after.positions[vertex] - mesh.positions[vertex]).norm();
            anywhere = std::max(anywhere, moved);
            if (at_seam) beside = std::max(beside, moved);
        }
    }
    EXPECT_GT(anywhere, 0.2);
    EXPECT_LT(beside, 0.2 * anywhere);
}

TEST(Selection, AsksForTheMemoryOfItsShare) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    const auto bytes = [&](const Selection& selection) {
        return mesh_plan_of(mesh, Inputs(selection), {}).expected_bytes;
    };
    Selection one(mesh.triangles.size(), 0), half = one;
    one[0] = 1;
    std::fill(half.begin(), half.begin() + static_cast<std::ptrdiff_t>(half.size() / 2), 1);
    const double all = bytes({});
    EXPECT_EQ(bytes(Selection(half.size(), 1)), all);
    EXPECT_LT(bytes(one), 0.35 * all) << "the surface is made of the whole mesh";
    EXPECT_NEAR(bytes(half), (all + bytes(one)) / 2, 0.01 * all);
}

}  // namespace
}  // namespace tracked_mcf
