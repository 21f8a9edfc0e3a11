// SPDX-License-Identifier: GPL-3.0-or-later
// What the tests of sheets share: meshes whose parts share cells, and their elements.
#pragma once

#include <gtest/gtest.h>

#include "filter_tracked_mcf/core/octree/octree.h"
#include "tests/support/elements.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {

/// Separates the sheets by separate_sheets() (octree/sheets.h), links them by find_links()
/// (octree/sheet_links.h) and builds the levels (octree/octree.h).
inline TrackedElements build(const TriangleMesh& mesh, const Grid& grid, bool separate = true) {
    return build_tracked_elements(mesh, grid, Cubature::ThreePoints, separate);
}

/// A grid whose cells have side 1 and whose first corner is the origin.
inline Grid unit_grid(int depth) {
    return {Eigen::Vector3d::Zero(), 1, depth};
}

inline TriangleMesh axes_rotated(const TriangleMesh& mesh) {
    Eigen::Affine3d turn = Eigen::Affine3d::Identity();
    turn.linear() << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    return shapes::transformed(mesh, turn);
}

inline TriangleMesh moved(const TriangleMesh& mesh, const Eigen::Vector3d& by) {
    return shapes::transformed(mesh, Eigen::Affine3d(Eigen::Translation3d(by)));
}

inline TriangleMesh scaled(const TriangleMesh& mesh, double by) {
    return shapes::transformed(mesh, Eigen::Affine3d(Eigen::Scaling(by)));
}

/// Two nested spheres, a twentieth of the radius apart.
inline TriangleMesh close_shells() {
    return shapes::merged(shapes::bumpy_sphere(8), scaled(shapes::bumpy_sphere(9), 1.05));
}

/// A thin torus whose tube is narrower than a cell at depth 4.
inline TriangleMesh thin_torus() {
    return shapes::torus(40, 8, 1, 0.06);
}

/// A square of 8 by 8 quads in the plane x = y, its corners at (2, 2, 2) and (10, 10, 10).
inline TriangleMesh diagonal_square() {
    Eigen::Affine3d upright = Eigen::Affine3d::Identity();
    upright.linear() << 8, 0, 0, 8, 0, 0, 0, 8, 0;
    return moved(shapes::transformed(shapes::square(8), upright), {2, 2, 2});
}

inline bool same(const Level& a, const Level& b) {
    return a.cells == b.cells && a.unknowns == b.unknowns && a.parents == b.parents &&
           a.unknown_count() == b.unknown_count();
}

inline void expect_same_levels(const TrackedElements& a, const TrackedElements& b) {
    ASSERT_EQ(a.levels.size(), b.levels.size());
    for (std::size_t level = 0; level < a.levels.size(); ++level) {
        EXPECT_TRUE(same(a.levels[level], b.levels[level])) << level;
    }
}

}  // namespace tracked_mcf
