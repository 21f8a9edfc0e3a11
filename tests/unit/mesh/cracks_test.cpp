// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/cracks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/fair.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/remove_noise.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

constexpr int kAround = 60, kAlong = 20;

/// Returns a torus that is cut along a circle. The vertices on one side of the cut are moved by
/// `gap` along the axis, in edges.
TriangleMesh cut_torus(double gap) {
    const double turn = 2 * std::acos(-1.0);
    TriangleMesh mesh;
    for (int i = 0; i <= kAround; ++i) {
        for (int j = 0; j < kAlong; ++j) {
            const double u = turn * (i % kAround) / kAround, v = turn * j / kAlong;
            const double r = 3 + std::cos(v);
            mesh.positions.emplace_back(r * std::cos(u), r * std::sin(u), std::sin(v));
        }
    }
    for (int i = 0; i < kAround; ++i) {
        for (int j = 0; j < kAlong; ++j) {
            const auto at = [&](int a, int b) { return a * kAlong + b % kAlong; };
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    const double edge = mean_edge_length(mesh);
    for (std::size_t i = kAround * kAlong; i < mesh.positions.size(); ++i) {
        mesh.positions[i][2] += gap * edge;
    }
    return mesh;
}

/// Returns the largest distance of two vertices on both sides of the cut, in edges.
double opening(const TriangleMesh& mesh) {
    double largest = 0;
    for (int j = 0; j < kAlong; ++j) {
        const Eigen::Vector3d across = mesh.positions[j] - mesh.positions[kAround * kAlong + j];
        largest = std::max(largest, across.norm());
    }
    return largest / mean_edge_length(mesh);
}

TriangleMesh with_noise(TriangleMesh mesh) {
    std::mt19937 random(1);
    std::normal_distribution<double> noise(0, 0.1 * mean_edge_length(mesh));
    for (int i = 0; i < kAround * kAlong; ++i) {
        const Eigen::Vector3d moved(noise(random), noise(random), noise(random));
        mesh.positions[i] += moved;
        if (i < kAlong) mesh.positions[kAround * kAlong + i] += moved;
    }
    return mesh;
}

TEST(Cracks, OfLessThanAMillionthOfTheDiagonalAreClosed) {
    // A shift of 1e-18 changes only the coordinates that are 0.
    for (const double gap : {1e-18, 1e-9, 1e-6}) {
        const Surface surface = surface_of(cut_torus(gap));
        EXPECT_EQ(surface.counts.cracks.joined_vertices, gap == 1e-18 ? 2 : kAlong);
        EXPECT_EQ(surface.counts.cracks.open_pairs, 0);
        EXPECT_EQ(surface.stars.count(), kAround * kAlong);
        EXPECT_EQ(surface.genus(), 1);
    }
}

TEST(Cracks, ThatAreWiderStayOpenAndAreReported) {
    for (const double gap : {1e-3, 5e-3}) {
        const TriangleMesh mesh = cut_torus(gap);
        const Surface surface = surface_of(mesh);
        EXPECT_EQ(surface.counts.cracks.joined_vertices, 0);
        EXPECT_EQ(surface.counts.cracks.open_pairs, kAlong);
        EXPECT_NEAR(surface.counts.cracks.open_width, gap * mean_edge_length(mesh), 1e-6);
        EXPECT_EQ(surface.stars.count(), (kAround + 1) * kAlong);
    }
    EXPECT_EQ(surface_of(cut_torus(0.1)).counts.cracks.open_pairs, 0) << "a gap like any other";
}

/// Returns two strips of squares of side 1 beside each other, which are so far apart.
TriangleMesh strips(int squares, double gap) {
    TriangleMesh mesh;
    for (const double y : {0.0, 1.0, 1 + gap, 2 + gap}) {
        for (int i = 0; i <= squares; ++i) mesh.positions.emplace_back(i, y, 0);
    }
    const int row = squares + 1;
    for (const int first : {0, 2 * row}) {
        for (int i = first; i < first + squares; ++i) {
            mesh.triangles.push_back({i, i + 1, i + 1 + row});
            mesh.triangles.push_back({i, i + 1 + row, i + row});
        }
    }
    return mesh;
}

TEST(Cracks, AreClosedUpToBothLimits) {
    const auto cracks_of = [](int squares, double gap) {
        return surface_of(strips(squares, gap)).counts.cracks;
    };
    // A millionth of the diagonal, and a ten-thousandth of the shortest edge.
    for (const auto& [squares, limit] : {std::pair(10, 1e-6 * std::hypot(10, 2)), {200, 1e-4}}) {
        EXPECT_EQ(cracks_of(squares, 0.99 * limit).joined_vertices, squares + 1);
        EXPECT_EQ(cracks_of(squares, 1.01 * limit).joined_vertices, 0);
        EXPECT_EQ(cracks_of(squares, 1.01 * limit).open_pairs, squares + 1);
    }
    EXPECT_EQ(cracks_of(10, 0.99e-2).open_pairs, 11);
    EXPECT_EQ(cracks_of(10, 1.01e-2).open_pairs, 0);
}

TEST(Cracks, AreNotWhereSheetsLieOnEachOther) {
    // Nearest vertices of two squares are pairs, so they count as a crack; three have no pairs.
    const Surface three = surface_of(shapes::stack(shapes::square(10), 3, 1e-9));
    EXPECT_EQ(three.counts.cracks.joined_vertices, 0);
    // Vertices in one place, but along rims that do not run beside each other.
    TriangleMesh fans{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1e-9, 0, 0}, {-1, 0, 0}, {0, -1, 0}},
                      {{0, 1, 2}, {3, 4, 5}}};
    EXPECT_EQ(surface_of(fans).counts.cracks.joined_vertices, 0);
}

TEST(Cracks, AreNotNarrowTriangles) {
    TriangleMesh strip;
    for (int i = 0; i <= 10; ++i) {
        strip.positions.emplace_back(i, 0, 0);
        strip.positions.emplace_back(i, 1e-8, 0);
        if (i == 10) continue;
        strip.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
        strip.triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
    }
    EXPECT_EQ(surface_of(strip).counts.cracks.joined_vertices, 0);
    EXPECT_EQ(surface_of(strip).counts.cracks.open_pairs, 0);
}

TEST(Cracks, DoNotDependOnTheOrderOfVertices) {
    TriangleMesh mesh = cut_torus(1e-9);
    std::reverse(mesh.positions.begin(), mesh.positions.end());
    const auto last = static_cast<std::int32_t>(mesh.positions.size()) - 1;
    for (Triangle& t : mesh.triangles) {
        for (std::int32_t& vertex : t) vertex = last - vertex;
    }
    EXPECT_EQ(surface_of(mesh).counts.cracks.joined_vertices, kAlong);
}

TEST(Cracks, StayShutInAllFilters) {
    const TriangleMesh before = with_noise(cut_torus(1e-9));
    TriangleMesh clean = before;
    const NoiseReport noise = remove_noise(clean, {}, {});
    EXPECT_EQ(noise.cracks.joined_vertices, kAlong);
    EXPECT_GT(noise.rms_displacement, 0);
    EXPECT_LT(opening(clean), 1e-6);

    TriangleMesh smooth = before;
    FlowParameters flow;
    flow.detail_size = 0.5;
    EXPECT_EQ(evolve(smooth, flow).cracks.joined_vertices, kAlong);
    EXPECT_LT(opening(smooth), 1e-6);

    // A patch across the cut.
    TriangleMesh fairer = before;
    Selection selection(before.triangles.size(), 0);
    for (int ring = -4; ring < 4; ++ring) {
        const int i = (ring + kAround) % kAround;
        for (int j = 0; j < 8; ++j) {
            selection[2 * (i * kAlong + j)] = selection[2 * (i * kAlong + j) + 1] = 1;
        }
    }
    const FairReport report = fair(fairer, selection, {});
    EXPECT_EQ(report.patches, 1);
    EXPECT_EQ(report.cracks.joined_vertices, kAlong);
    EXPECT_LT(opening(fairer), 1e-6);
    EXPECT_NE(fairer.positions[2], before.positions[2]);
}

}  // namespace
}  // namespace tracked_mcf
