// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/clusters.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

Sample whole_sample(const TriangleMesh& mesh) {
    return sample_of(surface_of_mesh(mesh), 1000000);
}

TEST(Clusters, OfSingleVerticesAreTheSurface) {
    const Sample sample = whole_sample(shapes::bumpy_sphere(6));
    const Clusters clusters = clusters_of(sample, 0);
    const Positions& found = clusters.sample.surface.positions;
    ASSERT_EQ(found.size(), sample.surface.positions.size());
    EXPECT_EQ(clusters.sample.surface.stars.triangles.size(),
              sample.surface.stars.triangles.size());
    for (const Eigen::Vector3d& position : found) {
        const auto same = [&](const Eigen::Vector3d& other) {
            return (clusters.edge * position - other).norm() < 1e-12;
        };
        EXPECT_EQ(
            std::count_if(sample.surface.positions.begin(), sample.surface.positions.end(), same),
            1);
    }
}

TEST(Clusters, OfAClosedSurfaceAreClosedAndHaveTheirMeanEdge) {
    const Sample sample = whole_sample(shapes::geodesic_sphere(20));
    double last = 1;
    for (const int radius : {1, 2, 3}) {
        const Clusters clusters = clusters_of(sample, radius);
        const NoisySurface& surface = clusters.sample.surface;
        EXPECT_TRUE(surface.stars.on_rim.empty()) << radius;
        double length = 0;
        for (const Triangle& t : surface.stars.triangles) {
            for (std::size_t k = 0; k < 3; ++k)
                length += (surface.positions[t[k]] - surface.positions[t[(k + 1) % 3]]).norm();
        }
        EXPECT_NEAR(length / (3 * double(surface.stars.triangles.size())), 1, 1e-12);
        EXPECT_GT(clusters.edge, last + 0.5) << radius;
        EXPECT_EQ(std::count(surface.fidelity.begin(), surface.fidelity.end(), 1.0F),
                  surface.stars.count());
        last = clusters.edge;
    }
}

TEST(Clusters, MoveIfAVertexDoesAndCountIfAllDo) {
    Sample sample = whole_sample(shapes::bumpy_sphere(10));
    sample.surface.fidelity.assign(sample.surface.fidelity.size(), 0);
    sample.counts.assign(sample.counts.size(), 1);
    sample.surface.fidelity[7] = 1;
    sample.counts[9] = 0;
    const Clusters clusters = clusters_of(sample, 1);
    const std::vector<float>& fidelity = clusters.sample.surface.fidelity;
    EXPECT_EQ(std::count(fidelity.begin(), fidelity.end(), 1.0F), 1);
    EXPECT_EQ(std::count(clusters.sample.counts.begin(), clusters.sample.counts.end(), 0), 1);
}

}  // namespace
}  // namespace tracked_mcf
