// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/octree/sheets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <string>

#include "filter_tracked_mcf/core/cells/bspline.h"
#include "filter_tracked_mcf/core/cells/clip.h"
#include "filter_tracked_mcf/core/mesh/weld.h"
#include "filter_tracked_mcf/core/parallel/disjoint_sets.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "tests/unit/octree/sheets.h"

namespace tracked_mcf {
namespace {

/// Integer coordinates of a cell, or of a corner of cells.
using Key = std::array<int, 3>;

Key key_of(const Cell& cell) {
    return {cell[0], cell[1], cell[2]};
}

std::map<Key, int> count_elements(const Level& level) {
    std::map<Key, int> count;
    for (const MortonCode cell : level.cells) ++count[key_of(cell_at(cell))];
    return count;
}

std::map<Key, int> count_unknowns(const Level& level) {
    std::map<Key, std::set<std::int32_t>> unknowns;
    for (std::int32_t element = 0; element < level.element_count(); ++element) {
        for (int corner = 0; corner < 8; ++corner) {
            const Cell offset(corner_bit(corner, 0), corner_bit(corner, 1), corner_bit(corner, 2));
            unknowns[key_of(cell_at(level.cells[element]) + offset)].insert(
                level.unknowns[element][corner]);
        }
    }
    std::map<Key, int> count;
    for (const auto& [corner, of_corner] : unknowns) {
        count[corner] = static_cast<int>(of_corner.size());
    }
    return count;
}

/// Counts elements and unknowns by their definition: the connected parts of the surface in a box,
/// which is a cell or a support.
class Oracle {
public:
    Oracle(const TriangleMesh& mesh, const Grid& grid)
        : mesh_(to_grid(mesh, grid)), welded_(weld_coincident_vertices(mesh)), grid_(grid) {}

    std::map<Key, int> elements(int level) const { return count_parts(level, {Cell(0, 0, 0)}, 1); }
    std::map<Key, int> unknowns(int level) const {
        std::vector<Cell> offsets;
        offsets.reserve(8);
        for (int corner = 0; corner < 8; ++corner) {
            offsets.emplace_back(corner_bit(corner, 0), corner_bit(corner, 1),
                                 corner_bit(corner, 2));
        }
        return count_parts(level, offsets, 2);
    }

private:
    /// Counts the parts in the boxes at these offsets from occupied cells. A box is `side` cells
    /// wide and ends one cell above its key.
    std::map<Key, int> count_parts(int level, const std::vector<Cell>& offsets, int side) const {
        const int cell_size = 1 << (grid_.depth - level);
        std::map<Key, std::set<std::int32_t>> triangles;
        const auto count = static_cast<std::int32_t>(mesh_.original.triangles.size());
        for (std::int32_t triangle = 0; triangle < count; ++triangle) {
            for_each_fragment(mesh_.corners(triangle), grid_.cells_per_side(),
                              [&](const Cell& cell, const Polygon&) {
                                  for (const Cell& offset : offsets) {
                                      triangles[key_of(cell / cell_size + offset)].insert(triangle);
                                  }
                              });
        }
        std::map<Key, int> parts;
        for (const auto& [at, of_box] : triangles) {
            const Eigen::Vector3d upper(at[0] + 1, at[1] + 1, at[2] + 1);
            const Eigen::AlignedBox3d box(cell_size * (upper - Eigen::Vector3d::Constant(side)),
                                          cell_size * upper);
            parts[at] = count_parts({of_box.begin(), of_box.end()}, box);
        }
        return parts;
    }

    int count_parts(const std::vector<std::int32_t>& triangles,
                    const Eigen::AlignedBox3d& box) const {
        DisjointSets parts(static_cast<std::int32_t>(triangles.size()));
        std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t>
            first;  // by edge, or (v, v) for a vertex v
        for (std::int32_t i = 0; i < static_cast<std::int32_t>(triangles.size()); ++i) {
            const Triangle& t = mesh_.original.triangles[triangles[i]];
            const auto corners = mesh_.corners(triangles[i]);
            for (int a = 0; a < 3; ++a) {
                const int b = (a + 1) % 3;
                const std::pair ends(std::minmax(welded_[t[a]], welded_[t[b]]));
                if (box.contains(corners[a])) {
                    parts.unite(i,
                                first.try_emplace({welded_[t[a]], welded_[t[a]]}, i).first->second);
                }
                if (meet(corners[a], corners[b], box)) {
                    parts.unite(i, first.try_emplace(ends, i).first->second);
                }
            }
        }
        std::set<std::int32_t> representatives;
        for (std::int32_t i = 0; i < static_cast<std::int32_t>(triangles.size()); ++i) {
            representatives.insert(parts.find(i));
        }
        return static_cast<int>(representatives.size());
    }

    /// Returns whether a segment and a box share more than a point.
    static bool meet(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                     const Eigen::AlignedBox3d& box) {
        double enter = 0;
        double leave = 1;
        for (int axis = 0; axis < 3; ++axis) {
            const double slope = b[axis] - a[axis];
            if (slope == 0) {
                if (a[axis] < box.min()[axis] || a[axis] > box.max()[axis]) return false;
                continue;
            }
            const double at_min = (box.min()[axis] - a[axis]) / slope;
            const double at_max = (box.max()[axis] - a[axis]) / slope;
            enter = std::max(enter, std::min(at_min, at_max));
            leave = std::min(leave, std::max(at_min, at_max));
        }
        return leave > enter + 1e-13;
    }

    GridMesh mesh_;
    std::vector<std::int32_t> welded_;
    Grid grid_;
};

void expect_connected_parts(const TriangleMesh& mesh, const Grid& grid, const std::string& name) {
    const TrackedElements elements = build(mesh, grid);
    const Oracle oracle(mesh, grid);
    for (int level = 0; level <= grid.depth; ++level) {
        EXPECT_EQ(count_elements(elements.levels[level]), oracle.elements(level))
            << name << ", level " << level;
        EXPECT_EQ(count_unknowns(elements.levels[level]), oracle.unknowns(level))
            << name << ", level " << level;
    }
}

void expect_connected_parts(const TriangleMesh& mesh, int depth, const std::string& name) {
    expect_connected_parts(mesh, enclosing_grid(mesh, depth), name);
}

/// Maps x to y, y to z and z to x, exactly.
/// Returns the triangles in another order.
TriangleMesh shuffled(TriangleMesh mesh) {
    std::mt19937 random(3);
    std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
    return mesh;
}

/// A cone of four triangles, open at the base. Its apex is the origin, its axis is along x.
TriangleMesh cone(double length) {
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0},
                      {length, 0.3, 0.3},
                      {length, -0.3, 0.3},
                      {length, -0.3, -0.3},
                      {length, 0.3, -0.3}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}};
    return mesh;
}

int elements_in_middle_cell(const TriangleMesh& mesh) {
    return count_elements(build(mesh, unit_grid(2)).finest())[{1, 1, 1}];
}

TriangleMesh triangles(const std::vector<Eigen::Vector3d>& positions,
                       const std::vector<Triangle>& faces) {
    return {positions, faces};
}

// The cases below count the sheets in the cell [1, 2]³.

TEST(Sheets, ParallelSheetsAreSeparate) {
    const auto sheet = [](double z) {
        return triangles({{1.2, 1.2, z}, {1.8, 1.2, z}, {1.5, 1.8, z}}, {{0, 1, 2}});
    };
    EXPECT_EQ(elements_in_middle_cell(shapes::merged(sheet(1.4), sheet(1.6))), 2);
    EXPECT_EQ(
        elements_in_middle_cell(shapes::merged(shapes::merged(sheet(1.4), sheet(1.6)), sheet(1.5))),
        3);
}

TEST(Sheets, AFoldIsOneSheetOnlyWhereItsEdgePasses) {
    const auto fold = [](double x) {
        return triangles({{x, 0.5, 1.5}, {x, 2.5, 1.5}, {0.2, 1.5, 1.3}, {0.2, 1.5, 1.7}},
                         {{0, 1, 2}, {0, 1, 3}});
    };
    EXPECT_EQ(elements_in_middle_cell(fold(1.7)), 1);
    EXPECT_EQ(elements_in_middle_cell(fold(2.3)), 2);
}

TEST(Sheets, AnyNumberOfTrianglesAtAnEdgeAreOneSheet) {
    std::vector<Eigen::Vector3d> positions = {{1.5, 1.5, 0.5}, {1.5, 1.5, 2.5}};
    std::vector<Triangle> faces;
    for (std::int32_t i = 2; i < 7; ++i) {
        positions.emplace_back(1.5 + std::cos(i), 1.5 + std::sin(i), 1.5);
        faces.push_back({i % 2, i, 1 - i % 2});
    }
    EXPECT_EQ(elements_in_middle_cell(triangles(positions, faces)), 1);
}

TEST(Sheets, AFinIsPartOfItsSheet) {
    TriangleMesh mesh = triangles(
        {{1.1, 1.1, 1.5}, {1.9, 1.1, 1.5}, {1.5, 1.9, 1.5}, {1.5, 1.2, 1.9}, {1.5, 1.5, 1.9}},
        {{0, 1, 2}, {0, 1, 3}});
    EXPECT_EQ(elements_in_middle_cell(mesh), 1);
    mesh.triangles.push_back({4, 4, 3});  // a needle on the fin
    EXPECT_EQ(elements_in_middle_cell(mesh), 1);
    mesh.positions.emplace_back(1.2, 1.9, 1.9);
    mesh.triangles.push_back({5, 5, 5});  // an isolated point
    EXPECT_EQ(elements_in_middle_cell(mesh), 2);
}

TEST(Sheets, ConesAreOneSheetOnlyAtTheirCommonApex) {
    const TriangleMesh cones = shapes::merged(cone(0.9), cone(-0.9));
    EXPECT_EQ(elements_in_middle_cell(moved(cones, {1.5, 1.5, 1.5})), 1);
    const TriangleMesh nested = shapes::merged(cone(2), scaled(cone(1.5), 1.3));
    EXPECT_EQ(elements_in_middle_cell(moved(nested, {1.01, 1.5, 1.5})), 1);
    EXPECT_EQ(elements_in_middle_cell(moved(nested, {0.99, 1.5, 1.5})), 2);
}

TEST(Sheets, CopiesOfATriangleAreOneSheetOnlyWhereTheirEdgesPass) {
    const TriangleMesh small =
        triangles({{1.2, 1.2, 1.5}, {1.8, 1.2, 1.5}, {1.5, 1.8, 1.5}}, {{0, 1, 2}, {1, 0, 2}});
    EXPECT_EQ(elements_in_middle_cell(small), 1);
    const TriangleMesh large =
        triangles({{0.1, 0.1, 1.5}, {3.9, 0.1, 1.5}, {1.5, 3.9, 1.5}}, {{0, 1, 2}, {1, 0, 2}});
    const auto count = count_elements(build(large, unit_grid(2)).finest());
    EXPECT_EQ(count.at({1, 1, 1}), 2);
    EXPECT_EQ(count.at({0, 0, 1}), 1);
}

TEST(Sheets, ElementsAndUnknownsAreTheConnectedPartsOnEveryLevel) {
    expect_connected_parts(shapes::bumpy_sphere(12), 5, "bumpy sphere");
    expect_connected_parts(close_shells(), 4, "close shells");
    expect_connected_parts(shuffled(close_shells()), 4, "close shells, shuffled");
    expect_connected_parts(thin_torus(), 4, "thin torus");
    expect_connected_parts(shapes::moebius_band(30, 4), 4, "Moebius band");
    expect_connected_parts(shapes::separate_triangles(500), 5, "separate triangles");
    expect_connected_parts(shapes::geodesic_sphere(1), 6, "triangles of many cells");
    TriangleMesh mixed = shapes::torus(12, 6, 1, 0.5);
    mixed.positions.emplace_back(0, 0, 0);
    const auto extra = static_cast<std::int32_t>(mixed.positions.size()) - 1;
    mixed.triangles.push_back({3, extra, extra});                // a needle to the middle
    mixed.triangles.push_back({extra, 20, 45});                  // a fin from there
    mixed.triangles.push_back(mixed.triangles[10]);              // a copy
    mixed.triangles.push_back({mixed.triangles[11][0], 7, 40});  // through everything
    expect_connected_parts(mixed, 4, "mixed");
}

TEST(Sheets, StayConnectedAcrossManyCells) {
    TriangleMesh plate = moved(shapes::box(1, {70, 70, 2}), {20, 20, 64});
    // A needle through corners of the grid: no two of its cells share more than a corner.
    const auto end = static_cast<std::int32_t>(plate.positions.size());
    plate.positions.emplace_back(4, 4, 4);
    plate.positions.emplace_back(100, 100, 100);
    plate.triangles.push_back({end, end + 1, end + 1});
    expect_connected_parts(plate, unit_grid(7), "plate");
}

TEST(Sheets, StayConnectedWhereMeshEdgesLieInGridPlanesAndLines) {
    // Grid planes are at whole numbers.
    const std::map<std::string, TriangleMesh> meshes = {
        {"box, coarse", moved(shapes::box(1, {8, 8, 8}), {4, 4, 4})},
        {"box, as fine as the grid", moved(shapes::box(8, {8, 8, 8}), {4, 4, 4})},
        {"box, oblong", moved(shapes::box(3, {9, 6, 3}), {1, 4, 9})},
        {"box, thin", moved(shapes::box(4, {8, 8, 0.25}), {4, 4, 8})},
        {"box, a cell thick", moved(shapes::box(4, {8, 8, 1}), {4, 4, 8})},
        {"diagonal square", diagonal_square()},
        {"sphere", moved(scaled(shapes::geodesic_sphere(4), 7), {8, 8, 8})},
        {"torus", moved(scaled(shapes::torus(16, 8, 1, 0.3), 6), {8, 8, 8})},
        {"square", moved(scaled(shapes::square(3), 9), {3, 2, 5})},
        {"cones with an apex at a grid corner",
         moved(shapes::merged(cone(3), cone(-3)), {8, 8, 8})},
        {"cones with an apex on a grid line",
         moved(shapes::merged(cone(3), cone(-3)), {8, 8, 7.6})},
    };
    for (const auto& [name, mesh] : meshes) {
        TriangleMesh turned = mesh;
        for (int turn = 0; turn < 3; ++turn) {
            expect_connected_parts(turned, unit_grid(4), name + ", turn " + std::to_string(turn));
            turned = axes_rotated(turned);
        }
    }
}

TEST(Sheets, OfASoupAreThoseOfItsMesh) {
    const TriangleMesh mesh = close_shells();
    const Grid grid = enclosing_grid(mesh, 5);
    const TrackedElements welded = build(mesh, grid);
    const TrackedElements soup = build(shapes::soup(mesh), grid);
    expect_same_levels(welded, soup);
    EXPECT_EQ(welded.fragment_begin, soup.fragment_begin);
    EXPECT_GT(welded.finest().element_count(), count_cells(welded.finest()));
}

TEST(Sheets, AreTheSameAtAnyNumberOfThreads) {
    const TriangleMesh mesh =
        shapes::merged(shapes::bumpy_sphere(60), scaled(shapes::bumpy_sphere(50), 1.01));
    const Grid grid = enclosing_grid(mesh, 6);
    const auto at = [&](int threads) {
        const ThreadTeam scope(threads);
        return build(mesh, grid);
    };
    const TrackedElements one = at(1);
    EXPECT_GT(one.finest().element_count(), count_cells(one.finest()) + 1000);
    for (const int threads : {2, 3, 5}) {
        const TrackedElements several = at(threads);
        expect_same_levels(several, one);
        EXPECT_EQ(several.fragment_begin, one.fragment_begin);
    }
}

TEST(Sheets, UnseparatedHaveOneElementPerCellAndOneUnknownPerCorner) {
    const TriangleMesh mesh = close_shells();
    const TrackedElements elements = build(mesh, enclosing_grid(mesh, 4), false);
    for (const Level& level : elements.levels) {
        for (const auto& [cell, count] : count_elements(level)) EXPECT_EQ(count, 1);
        for (const auto& [corner, count] : count_unknowns(level)) EXPECT_EQ(count, 1);
    }
}

TEST(Sheets, IdentityCoefficientsReproduceEveryVertex) {
    for (const TriangleMesh& mesh : {close_shells(), thin_torus(), shapes::moebius_band(30, 4),
                                     shapes::separate_triangles(500)}) {
        const TrackedElements elements = build(mesh, enclosing_grid(mesh, 4));
        const Coefficients identity = identity_coefficients(elements);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const Eigen::Vector3d in_grid =
                evaluate_vertex(elements, identity, elements.vertices[i]);
            EXPECT_LT((in_grid - elements.grid.to_grid(mesh.positions[i])).norm(), 1e-12 * 16);
        }
    }
}

TEST(Sheets, TheIdentityIsOneMapOnEveryElement) {
    // The eight functions of an element belong to the eight corners of its cell.
    const TriangleMesh mesh = close_shells();
    const TrackedElements elements = build(mesh, enclosing_grid(mesh, 4));
    const Coefficients identity = identity_coefficients(elements);
    for (std::int32_t element = 0; element < elements.finest().element_count(); ++element) {
        const Cell cell = cell_at(elements.finest().cells[element]);
        for (int corner = 0; corner < 8; ++corner) {
            const std::int32_t unknown = elements.finest().unknowns[element][corner];
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_EQ(identity(unknown, axis), cell[axis] + corner_bit(corner, axis));
            }
        }
    }
}

}  // namespace
}  // namespace tracked_mcf
