// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/noisy_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "filter_tracked_mcf/core/noise/sharpening.h"
#include "tests/support/shapes.h"
#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

using Point = std::array<double, 3>;

constexpr std::int32_t kSampled = 4000;

/// Returns a sphere whose vertices have different distances from the middle.
TriangleMesh uneven_sphere() {
    TriangleMesh mesh = shapes::geodesic_sphere(40);
    for (Eigen::Vector3d& p : mesh.positions) p[0] += 0.2 * p[1] * p[1] + 0.1 * p[1] + 0.3 * p[2];
    return mesh;
}

TEST(Sample, IsRegionsOfALargeSurfaceAndAllOfASmallOne) {
    const NoisySurface large = surface_of_mesh(uneven_sphere());
    const Sample sample = sample_of(large, kSampled);
    EXPECT_GE(sample.surface.stars.count(), kSampled);
    EXPECT_LE(sample.surface.stars.count(), 3 * kSampled / 2);
    const auto whole = std::count(sample.counts.begin(), sample.counts.end(), 1);
    EXPECT_GT(whole, 3 * kSampled / 4) << "most stars are whole";
    EXPECT_LT(whole, sample.surface.stars.count());
    const NoisySurface small = surface_of_mesh(shapes::geodesic_sphere(10));
    EXPECT_EQ(sample_of(small, kSampled).surface.stars.count(), small.stars.count());
}

TEST(Sample, DoesNotDependOnTheOrderOfVertices) {
    const auto signs_at = [](const TriangleMesh& mesh) {
        const Sample sample = sample_of(surface_of_mesh(mesh), kSampled);
        std::set<std::pair<Point, float>> found;
        for (std::size_t i = 0; i < sample.signs.size(); ++i) {
            const Eigen::Vector3d& at = sample.surface.positions[i];
            found.insert({{at[0], at[1], at[2]}, sample.signs[i]});
        }
        return found;
    };
    // Many vertices of the last two have the same distance from the middle.
    for (const TriangleMesh& mesh :
         {uneven_sphere(), shapes::geodesic_sphere(40), shapes::box(30, {1, 2, 3})}) {
        TriangleMesh reversed = mesh;
        std::reverse(reversed.positions.begin(), reversed.positions.end());
        const auto last = static_cast<std::int32_t>(mesh.positions.size()) - 1;
        for (Triangle& t : reversed.triangles) {
            for (std::int32_t& vertex : t) vertex = last - vertex;
        }
        EXPECT_TRUE(signs_at(mesh) == signs_at(reversed));
    }
}

TEST(Sharpening, StopsBeforeAVertexLeavesTheBox) {
    TriangleMesh roof = shapes::square(20);  // with a round ridge, which rises
    for (Eigen::Vector3d& p : roof.positions) p.z() = -std::hypot(p.x() - 0.5, 0.05);
    const NoisySurface surface = surface_of_mesh(roof);
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& position : surface.positions) box.extend(position);
    const auto sharpened_within = [&](const Eigen::AlignedBox3d& within) {
        Positions positions;
        sharpen(surface, 0.5, {15}, std::numeric_limits<double>::infinity(), within,
                surface.positions,
                [&](std::size_t, Positions sharpened) { positions = std::move(sharpened); });
        return positions;
    };
    const Positions confined = sharpened_within(box);
    const auto is_inside = [&](const Eigen::Vector3d& position) { return box.contains(position); };
    EXPECT_TRUE(std::all_of(confined.begin(), confined.end(), is_inside));
    const Positions free = sharpened_within(confinement(surface.positions));
    EXPECT_FALSE(std::all_of(free.begin(), free.end(), is_inside));
}

}  // namespace
}  // namespace tracked_mcf
