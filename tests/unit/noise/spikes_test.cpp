// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/spikes.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

/// Moves every hundredth vertex of a mesh along its normal, by so many edges.
TriangleMesh with_spikes(TriangleMesh mesh, double height) {
    const double edge = mean_edge_length(mesh);
    const std::vector<Eigen::Vector3d> normals = vertex_normals(mesh);
    for (std::size_t i = 50; i < normals.size(); i += 100)
        mesh.positions[i] += height * edge * normals[i];
    return mesh;
}

TEST(Spikes, AreFoundWhateverNoiseIsBesideThem) {
    const TriangleMesh clean = shapes::geodesic_sphere(20);
    const std::size_t count = (clean.positions.size() + 49) / 100;
    for (const double noise : {0.0, 0.2}) {
        for (const double height : {-5.0, 3.0, 5.0}) {
            const NoisySurface surface =
                surface_of_mesh(with_spikes(with_noise(clean, noise), height));
            const std::vector<Spike> spikes = spikes_of(surface);
            EXPECT_EQ(spikes.size(), count) << height;
            for (const Spike& spike : spikes) {
                EXPECT_EQ(spike.vertex % 100, 50);
                const double moved = (spike.place - surface.positions[spike.vertex]).norm();
                EXPECT_NEAR(moved, std::abs(height), 0.1 * std::abs(height) + 4 * noise);
            }
        }
    }
}

TEST(Spikes, AreNeitherCornersNorTipsNorNoise) {
    TriangleMesh tip = shapes::geodesic_sphere(20);
    for (Eigen::Vector3d& p : tip.positions) {
        const double distance = std::hypot(p.x(), p.y());
        if (p.z() > 0) p.z() += 2 * std::exp(-distance / 0.05);
    }
    for (const TriangleMesh& mesh : {cube(), tip, with_noise(shapes::geodesic_sphere(20), 0.4)})
        EXPECT_TRUE(spikes_of(surface_of_mesh(mesh)).empty());
}

TEST(Spikes, AreNotOnTheRimNorHeld) {
    TriangleMesh sheet = shapes::square(20);
    const double edge = mean_edge_length(sheet);
    sheet.positions[0].z() += 5 * edge;
    const std::size_t middle = sheet.positions.size() / 2;
    sheet.positions[middle].z() += 5 * edge;
    NoisySurface surface = surface_of_mesh(sheet);
    ASSERT_EQ(spikes_of(surface).size(), 1U);
    EXPECT_EQ(spikes_of(surface).front().vertex, static_cast<std::int32_t>(middle));
    surface.fidelity[middle] = 0;
    EXPECT_TRUE(spikes_of(surface).empty());
}

}  // namespace
}  // namespace tracked_mcf
