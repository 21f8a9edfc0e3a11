// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/cells/clip.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>
#include <set>

namespace tracked_mcf {
namespace {

using Corners = std::array<Eigen::Vector3d, 3>;

double area(const Polygon& polygon) {
    Eigen::Vector3d twice = Eigen::Vector3d::Zero();
    for (int i = 2; i < polygon.size; ++i) {
        twice += (polygon.points[i - 1] - polygon.points[0])
                     .cross(polygon.points[i] - polygon.points[0]);
    }
    return 0.5 * twice.norm();
}

Polygon in_slab(const Corners& corners, int axis, std::int32_t slab) {
    const Polygon triangle = whole_triangle(corners);
    Polygon part;
    return clip_to_slab(triangle, extent_along(triangle, axis), axis, slab, part);
}

struct Clipped {
    int fragments = 0;
    double area = 0;
    std::set<std::array<int, 3>> cells;
};

/// Clips a triangle and checks, on the way, that every fragment lies in its cell and that
/// clip_to_cell gives the same one.
Clipped clip(const Corners& corners, int cells_per_side) {
    Clipped result;
    for_each_fragment(corners, cells_per_side, [&](const Cell& cell, const Polygon& polygon) {
        for (int i = 0; i < polygon.size; ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_GE(polygon.points[i][axis], cell[axis]);
                EXPECT_LE(polygon.points[i][axis], cell[axis] + 1);
            }
        }
        const Polygon again = clip_to_cell(corners, cell);
        EXPECT_EQ(again.size, polygon.size);
        for (int i = 0; i < polygon.size; ++i) {
            EXPECT_EQ(again.points[i], polygon.points[i]);
            EXPECT_EQ(again.corner[i], polygon.corner[i]);
            EXPECT_EQ(again.edge[i], polygon.edge[i]);
        }
        ++result.fragments;
        result.area += area(polygon);
        result.cells.insert({cell[0], cell[1], cell[2]});
    });
    return result;
}

TEST(Clip, AreasOfFragmentsAddUpToTheTriangles) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> coordinate(0, 16);
    for (int i = 0; i < 200; ++i) {
        Corners corners;
        for (auto& corner : corners) {
            corner = {coordinate(random), coordinate(random), coordinate(random)};
        }
        const double expected = area(whole_triangle(corners));
        EXPECT_NEAR(clip(corners, 16).area, expected, 1e-12 * expected);
    }
}

TEST(Clip, VerticesOnCornersEdgesAndFacesOfTheGrid) {
    std::mt19937 random(2);
    std::uniform_int_distribution<int> halves(0, 16);
    for (int i = 0; i < 500; ++i) {
        Corners corners;
        for (auto& corner : corners) {
            for (int axis = 0; axis < 3; ++axis) corner[axis] = 0.5 * halves(random);
        }
        const double expected = area(whole_triangle(corners));
        const Clipped result = clip(corners, 8);
        EXPECT_NEAR(result.area, expected, 1e-12 * expected);
        EXPECT_EQ(result.cells.size(), static_cast<std::size_t>(result.fragments));
    }
}

TEST(Clip, TriangleInACellFaceBelongsToTheCellAbove) {
    const Clipped result = clip({{{1, 1, 3}, {3, 1, 3}, {1, 3, 3}}}, 8);
    EXPECT_EQ(result.cells, (std::set<std::array<int, 3>>{{1, 1, 3}, {2, 1, 3}, {1, 2, 3}}));
    EXPECT_DOUBLE_EQ(result.area, 2);
}

TEST(Clip, TriangleInTheOutermostFaceBelongsToTheLastCell) {
    const Clipped result = clip({{{0, 0, 4}, {1, 0, 4}, {0, 1, 4}}}, 4);
    EXPECT_EQ(result.cells, (std::set<std::array<int, 3>>{{0, 0, 3}}));
}

TEST(Clip, ATouchIsNoFragment) {
    // A corner and an edge of the triangle touch the plane x = 2 from below.
    EXPECT_EQ(clip({{{1.5, 0.2, 0.2}, {2, 0.4, 0.3}, {2, 0.6, 0.5}}}, 4).cells,
              (std::set<std::array<int, 3>>{{1, 0, 0}}));
}

TEST(Clip, DegenerateTrianglesStillMeetCells) {
    const Eigen::Vector3d point(1.5, 1.5, 1.5);
    EXPECT_EQ(clip({point, point, point}, 4).cells, (std::set<std::array<int, 3>>{{1, 1, 1}}));
    const Clipped segment = clip({{{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}, {2.5, 0.5, 0.5}}}, 4);
    EXPECT_EQ(segment.cells, (std::set<std::array<int, 3>>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}));
    EXPECT_EQ(segment.area, 0);
}

TEST(Clip, SidesRememberTheirEdgeAndPointsTheirCorner) {
    const Corners corners = {{{0.5, 0.5, 0.5}, {1.5, 0.5, 0.5}, {0.5, 0.75, 0.5}}};
    const Polygon left = clip_to_cell(corners, Cell(0, 0, 0));
    ASSERT_EQ(left.size, 4);
    // Corner 0 along edge 0 to the cut, along the cut, back along edge 1 to corner 2, along edge 2.
    EXPECT_EQ(left.corner[0], 0);
    EXPECT_EQ(left.corner[1], Polygon::kNone);
    EXPECT_EQ(left.corner[2], Polygon::kNone);
    EXPECT_EQ(left.corner[3], 2);
    EXPECT_EQ(left.edge[0], 0);
    EXPECT_EQ(left.edge[1], Polygon::kNone);
    EXPECT_EQ(left.edge[2], 1);
    EXPECT_EQ(left.edge[3], 2);
}

TEST(Clip, NeighboursOfACutShareItsPointsBitForBit) {
    const Corners corners = {{{0.1, 0.3, 0.7}, {1.9, 0.2, 0.1}, {0.4, 0.9, 0.8}}};
    const Polygon left = in_slab(corners, 0, 0);
    const Polygon right = in_slab(corners, 0, 1);
    const auto cuts = [](const Polygon& polygon) {
        std::set<std::array<double, 3>> points;
        for (int i = 0; i < polygon.size; ++i) {
            if (polygon.corner[i] == Polygon::kNone) {
                points.insert({polygon.points[i][0], polygon.points[i][1], polygon.points[i][2]});
            }
        }
        return points;
    };
    EXPECT_EQ(cuts(left).size(), 2U);
    EXPECT_EQ(cuts(left), cuts(right));
}

TEST(Clip, AFullPolygonKeepsItsPoints) {
    // A zigzag from inside the slab to both sides: most of its sides are cut twice.
    const auto x_at = [](int i) { return i == 0 ? 0.5 : i % 2 == 0 ? 2.0 : -1.0; };
    Polygon zigzag, part;
    for (int i = 0; i < Polygon::kCapacity; ++i) {
        zigzag.add({x_at(i), double(i), 0}, Polygon::kNone, Polygon::kNone);
    }
    cut_to_slab(zigzag, 0, 0, part);
    ASSERT_EQ(part.size, Polygon::kCapacity);
    for (int i = 0; i < part.size; ++i) {
        const double y = part.points[i][1];
        const int side = static_cast<int>(y);
        const double x = x_at(side) + (y - side) * (x_at(side + 1) - x_at(side));
        EXPECT_NEAR(part.points[i][0], x, 1e-12) << i;
    }
}

}  // namespace
}  // namespace tracked_mcf
