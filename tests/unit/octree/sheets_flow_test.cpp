// SPDX-License-Identifier: GPL-3.0-or-later
// The systems and the flows of surfaces whose sheets are separate.

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <map>
#include <set>
#include <string>

#include "filter_tracked_mcf/core/cells/bspline.h"
#include "filter_tracked_mcf/core/flow/flow.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/solver/paper/multigrid.h"
#include "filter_tracked_mcf/core/solver/paper/transfer.h"
#include "filter_tracked_mcf/core/system/constrained_cells.h"
#include "tests/support/plans.h"
#include "tests/unit/octree/sheets.h"

namespace tracked_mcf {
namespace {

/// The system of a flow's first step, without constraints.
struct System {
    System(const TriangleMesh& mesh, const Grid& grid)
        : elements(build(mesh, grid)),
          multigrid(elements, constrained_unknowns(elements, BoundaryCondition::Free)) {
        assemble_elements(elements, Coefficients::Zero(elements.finest().unknown_count(), 3),
                          {1, 0.5F}, systems);
        multigrid.refresh(systems.matrices);
    }

    TrackedElements elements;
    Multigrid multigrid;
    ElementSystems systems;
};

TEST(Sheets, CoarseMatricesAreTheGalerkinProducts) {
    for (const TriangleMesh& mesh :
         {close_shells(), thin_torus(), shapes::moebius_band(30, 4),
          shapes::separate_triangles(300), shapes::torus(30, 20, 1, 0.4)}) {
        const System system(mesh, enclosing_grid(mesh, 4));
        for (int level = 4; level > 0; --level) {
            using Double = Eigen::SparseMatrix<double, Eigen::RowMajor>;
            const Double fine = system.multigrid.matrix(level).matrix().cast<double>();
            const Double p =
                prolongation(system.elements.levels[level], system.elements.levels[level - 1])
                    .cast<double>();
            const Double coarse = system.multigrid.matrix(level - 1).matrix().cast<double>();
            const Double product = p.transpose() * fine * p;
            EXPECT_LT((coarse - product).norm(), 1e-6 * coarse.norm()) << level;
        }
    }
}

TEST(Sheets, AFineFunctionLiesInOnePartOfEachCoarseFunctionOverIt) {
    // All elements of a fine function have the same coarse functions.
    for (const TriangleMesh& mesh : {close_shells(), thin_torus(), shapes::moebius_band(30, 4)}) {
        const TrackedElements elements = build(mesh, enclosing_grid(mesh, 4));
        for (int l = 4; l > 0; --l) {
            const Level& fine = elements.levels[l];
            const Level& coarse = elements.levels[l - 1];
            std::vector<std::set<std::int32_t>> above(
                static_cast<std::size_t>(fine.unknown_count()));
            for (std::int32_t element = 0; element < fine.element_count(); ++element) {
                const auto weights = refinement_weights(octant_of(fine.cells[element]));
                for (int corner = 0; corner < 8; ++corner) {
                    std::set<std::int32_t> here;
                    for (int parent_corner = 0; parent_corner < 8; ++parent_corner) {
                        if (weights(corner, parent_corner) == 0) continue;
                        here.insert(coarse.unknowns[fine.parents[element]][parent_corner]);
                    }
                    auto& known = above[fine.unknowns[element][corner]];
                    if (known.empty()) known = here;
                    EXPECT_EQ(known, here);
                }
            }
        }
    }
}

FlowParameters one_step(double step_size) {
    FlowParameters parameters;
    parameters.step_size = step_size;
    parameters.boundary = BoundaryCondition::Free;
    parameters.solver = Solver::OneWCycle;
    return parameters;
}

TriangleMesh after_a_step(TriangleMesh mesh, const FlowParameters& parameters, const Grid& grid) {
    Flow flow(plan_of(mesh, parameters, grid));
    flow.step();
    flow.move_vertices(mesh.positions);
    return mesh;
}

bool same_bits(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
    return a.size() == b.size() &&
           std::memcmp(a[0].data(), b[0].data(), a.size() * sizeof(Eigen::Vector3d)) == 0;
}

TEST(Sheets, EqualUnseparatedBitForBitWhereNoTwoShareASupport) {
    const std::map<std::string, TriangleMesh> meshes = {
        {"box", moved(shapes::box(4, {8, 8, 8}), {4, 4, 4})},
        // Of a radius at which no support's edges cut the sphere in two, on any level.
        {"sphere", moved(scaled(shapes::geodesic_sphere(6), 7.55), {8, 8, 8})},
        {"square", moved(scaled(shapes::square(6), 9), {3, 2, 5})},
        {"diagonal square", diagonal_square()}};
    for (const auto& [name, mesh] : meshes) {
        TriangleMesh turned = mesh;
        for (int turn = 0; turn < 3; ++turn) {
            const Grid grid = unit_grid(4);
            expect_same_levels(build(turned, grid, true), build(turned, grid, false));
            FlowParameters parameters = one_step(1e-3);
            parameters.separate_sheets = true;
            const TriangleMesh separate = after_a_step(turned, parameters, grid);
            parameters.separate_sheets = false;
            const TriangleMesh glued = after_a_step(turned, parameters, grid);
            EXPECT_TRUE(same_bits(separate.positions, glued.positions)) << name << turn;
            EXPECT_FALSE(same_bits(separate.positions, turned.positions)) << name << turn;
            turned = axes_rotated(turned);
        }
    }
}

/// Pairs of surfaces at most a quarter of a cell apart on unit_grid(4).
std::vector<std::pair<TriangleMesh, TriangleMesh>> close_pieces() {
    const TriangleMesh sphere = scaled(shapes::geodesic_sphere(8), 3);
    const TriangleMesh plane = moved(scaled(shapes::square(10), 13), {1.3, 1.4, 4.2});
    return {{moved(sphere, {4.1, 8.2, 8.3}), moved(sphere, {10.35, 8.2, 8.3})},
            {moved(sphere, {8.1, 8.2, 7.45}), plane}};
}

/// A one-to-one map from numbers in a part to numbers in the whole.
class Correspondence {
public:
    void expect(std::int32_t of_part, std::int32_t of_whole) {
        EXPECT_EQ(whole_.try_emplace(of_part, of_whole).first->second, of_whole);
        EXPECT_EQ(part_.try_emplace(of_whole, of_part).first->second, of_part);
    }
    std::int32_t of_whole(std::int32_t part) const { return whole_.at(part); }

private:
    std::map<std::int32_t, std::int32_t> whole_, part_;
};

/// Maps the finest elements of the first and of the second piece to those of both together. In a
/// cell, the elements of the first piece come first.
std::array<Correspondence, 2> finest_elements_of(const Level& first, const Level& second,
                                                 const Level& both) {
    std::array<Correspondence, 2> elements;
    std::int32_t i = 0;
    std::int32_t j = 0;
    for (std::int32_t k = 0; k < both.element_count(); ++k) {
        if (i < first.element_count() && first.cells[i] == both.cells[k]) {
            elements[0].expect(i++, k);
        } else {
            EXPECT_EQ(second.cells.at(j), both.cells[k]);
            elements[1].expect(j++, k);
        }
    }
    return elements;
}

/// Expects that a piece has the same elements and unknowns alone as together with the other piece.
void expect_same_tree(const TrackedElements& part, const TrackedElements& whole,
                      Correspondence elements) {
    for (std::size_t l = part.levels.size(); l-- > 0;) {
        const Level& of_part = part.levels[l];
        const Level& of_whole = whole.levels[l];
        Correspondence unknowns;
        Correspondence parents;
        for (std::int32_t element = 0; element < of_part.element_count(); ++element) {
            const std::int32_t same_element = elements.of_whole(element);
            for (int corner = 0; corner < 8; ++corner) {
                unknowns.expect(of_part.unknowns[element][corner],
                                of_whole.unknowns[same_element][corner]);
            }
            if (l > 0) parents.expect(of_part.parents[element], of_whole.parents[same_element]);
        }
        elements = parents;
    }
}

auto as_eigen(const ElementMatrix& matrix) {
    return Eigen::Map<const Eigen::Matrix<float, 8, 8>>(matrix.entry[0]);
}

TEST(Sheets, OfTwoClosePiecesAreThoseOfEachAlone) {
    for (const auto& [first, second] : close_pieces()) {
        const System a(first, unit_grid(4));
        const System b(second, unit_grid(4));
        const System both(shapes::merged(first, second), unit_grid(4));
        const Level& finest = both.elements.finest();
        EXPECT_GT(finest.element_count(), count_cells(finest) + 2);
        for (std::size_t l = 0; l < both.elements.levels.size(); ++l) {
            EXPECT_EQ(both.elements.levels[l].unknown_count(),
                      a.elements.levels[l].unknown_count() + b.elements.levels[l].unknown_count());
        }
        const auto elements = finest_elements_of(a.elements.finest(), b.elements.finest(), finest);
        for (const auto& [part, same_elements] :
             {std::pair(&a, elements[0]), std::pair(&b, elements[1])}) {
            expect_same_tree(part->elements, both.elements, same_elements);
            for (std::int32_t i = 0; i < part->elements.finest().element_count(); ++i) {
                const ElementMatrix alone = part->systems.matrices.of(i);
                const ElementMatrix together = both.systems.matrices.of(same_elements.of_whole(i));
                EXPECT_EQ(as_eigen(alone), as_eigen(together));
            }
        }
    }
}

TEST(Sheets, TwoClosePiecesFlowAsEachAloneBitForBit) {
    for (const auto& [first, second] : close_pieces()) {
        const Grid grid = unit_grid(4);
        const TriangleMesh both = shapes::merged(first, second);
        // Step sizes are relative to the longest side.
        const auto step = [](const TriangleMesh& mesh) {
            return one_step(0.25 / (longest_side(mesh) * longest_side(mesh)));
        };
        TriangleMesh apart = shapes::merged(after_a_step(first, step(first), grid),
                                            after_a_step(second, step(second), grid));
        FlowParameters parameters = step(both);
        const TriangleMesh together = after_a_step(both, parameters, grid);
        EXPECT_TRUE(same_bits(together.positions, apart.positions));
        parameters.separate_sheets = false;
        const TriangleMesh glued = after_a_step(both, parameters, grid);
        EXPECT_FALSE(same_bits(glued.positions, apart.positions));
    }
}

TEST(Sheets, ManySeparateTrianglesFlow) {
    const TriangleMesh mesh = shapes::separate_triangles(20000);
    const Grid grid = enclosing_grid(mesh, 6);
    const Flow flow(plan_of(mesh, one_step(1e-5), grid));
    EXPECT_EQ(flow.stepper().elements().levels[0].element_count(), 20000);
    EXPECT_EQ(flow.stepper().elements().levels[0].unknown_count(), 8 * 20000);
    const TriangleMesh after = after_a_step(mesh, one_step(1e-5), grid);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        ASSERT_TRUE(after.positions[i].allFinite());
    }
    EXPECT_LT(surface_area(after), surface_area(mesh));
}

TEST(Sheets, AreCountedInTheReport) {
    const TriangleMesh mesh = close_shells();
    FlowParameters parameters;
    parameters.depth = 4;
    const Flow separate(plan_of(mesh, parameters));
    EXPECT_EQ(separate.report().elements, separate.stepper().elements().finest().element_count());
    EXPECT_GT(separate.report().elements, separate.report().cells);
    parameters.separate_sheets = false;
    const Flow glued(plan_of(mesh, parameters));
    EXPECT_EQ(glued.report().cells, separate.report().cells);
    EXPECT_EQ(glued.report().elements, glued.report().cells);
}

}  // namespace
}  // namespace tracked_mcf
