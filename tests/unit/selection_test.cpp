// Only what is selected flows, and flows as if it were alone with its rim held.

#include <gtest/gtest.h>

#include "filter_tracked_mcf/core/flow.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

/// Of every vertex, whether it must keep its bits: some triangle that is not selected has it.
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
    for (const auto boundary :
         {BoundaryCondition::Locked, BoundaryCondition::LockedCells, BoundaryCondition::Free}) {
        for (const Solver solver : {Solver::Converged, Solver::OneWCycle}) {
            FlowParameters p = parameters(6, 1e-3, 3);
            p.boundary = boundary;
            p.solver = solver;
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
        }
    }
}

TEST(Selection, FlowsAsItsPartOfTheMeshAlone) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    const Selection top = above(mesh, 0.3);
    FlowParameters p = parameters(6, 1e-3, 3);
    p.absolute = true;
    const TriangleMesh part = part_of(mesh, top);
    const Grid grid = enclosing_grid(mesh, 6);
    Flow of_selection(mesh, p, top);
    Flow of_part(part, p, grid);
    for (int step = 0; step < p.iterations; ++step) {
        of_selection.step();
        of_part.step();
    }
    TriangleMesh first = mesh, second = mesh;
    of_selection.move_vertices(first);
    of_part.move_vertices(second);
    EXPECT_TRUE(same_bits(first, second));
    EXPECT_FALSE(same_bits(first, mesh));
}

TEST(Selection, EverythingSelectedIsTheWholeMesh) {
    const TriangleMesh cap = bumpy_cap(15);
    TriangleMesh selected = cap;
    evolve(selected, Selection(cap.triangles.size(), 1), parameters(0, 1e-3, 3));
    EXPECT_TRUE(same_bits(selected, evolved(cap, parameters(0, 1e-3, 3))));
    EXPECT_GT(distance(selected, cap), 1e-3);
}

TEST(Selection, StepSizeAndCellsAreThoseOfTheWholeMesh) {
    const TriangleMesh mesh = shapes::bumpy_sphere(30);
    const Selection top = above(mesh, 0.8);
    TriangleMesh whole = mesh, part = mesh;
    const FlowReport of_whole = evolve(whole, parameters(0, 1e-4, 1));
    const FlowReport of_part = evolve(part, top, parameters(0, 1e-4, 1));
    EXPECT_EQ(of_part.cell_size, of_whole.cell_size);
    EXPECT_LT(3 * of_part.unknowns, of_whole.unknowns);
    // Away from the seam the part moves as it does in the whole.
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (mesh.positions[i][2] < 1) continue;
        EXPECT_NEAR((part.positions[i] - whole.positions[i]).norm(), 0, 1e-4) << i;
    }
}

TEST(Selection, SurfaceIsContinuousAtTheSeam) {
    // No vertex next to the seam moves by more than a share of what the middle of the part does.
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

}  // namespace
}  // namespace tracked_mcf
