// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/noisy_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "tests/support/shapes.h"

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

NoisySurface surface_of_mesh(const TriangleMesh& mesh) {
    return surface_of(Domain(mesh, BoundaryCondition::Free)).surface;
}

TEST(Sample, IsPatchesOfALargeSurfaceAndAllOfASmallOne) {
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
    TriangleMesh mesh = uneven_sphere(), reversed = mesh;
    std::reverse(reversed.positions.begin(), reversed.positions.end());
    const auto last = static_cast<std::int32_t>(mesh.positions.size()) - 1;
    for (Triangle& t : reversed.triangles) {
        for (std::int32_t& vertex : t) vertex = last - vertex;
    }
    // Positions are relative to those of the first vertex.
    const auto signs_at = [](const TriangleMesh& of, const Eigen::Vector3d& origin) {
        const SurfaceOfMesh result = surface_of(Domain(of, BoundaryCondition::Free));
        const Sample sample = sample_of(result.surface, kSampled);
        std::set<std::pair<Point, float>> found;
        for (std::size_t i = 0; i < sample.signs.size(); ++i) {
            const Eigen::Vector3d at =
                (result.edge * sample.surface.positions[i] + origin).array() * 1e6;
            found.insert(
                {{std::round(at[0]), std::round(at[1]), std::round(at[2])}, sample.signs[i]});
        }
        return found;
    };
    EXPECT_TRUE(signs_at(mesh, mesh.positions[0]) == signs_at(reversed, reversed.positions[0]));
}

}  // namespace
}  // namespace tracked_mcf
