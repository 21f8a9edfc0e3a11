// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/remove_noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "tests/support/measures.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_distance.h"
#include "tests/unit/cancelling.h"
#include "tests/unit/flows.h"
#include "tests/unit/noise/noisy.h"

namespace tracked_mcf {
namespace {

bool is_finite(const TriangleMesh& mesh) {
    return std::all_of(mesh.positions.begin(), mesh.positions.end(),
                       [](const Eigen::Vector3d& p) { return p.allFinite(); });
}

/// Five standard errors of the deviation of as many heights as the mesh has vertices, relative to
/// it.
double five_errors(const TriangleMesh& mesh) {
    return 5 / std::sqrt(2 * static_cast<double>(mesh.positions.size()));
}

TEST(RemoveNoise, MeasuresTheNoiseAndRemovesMostOfIt) {
    for (const TriangleMesh& clean :
         {shapes::geodesic_sphere(20), cube(), shapes::torus(80, 30, 1, 0.4)}) {
        for (const double deviation : {0.1, 0.3, 0.6}) {
            const TriangleMesh before = with_noise(clean, deviation);
            EXPECT_NEAR(report_of(before).noise / (deviation * mean_edge_length(clean)), 1,
                        five_errors(clean));
            expect_halved(denoised(before), before, clean);
        }
    }
}

TEST(RemoveNoise, KeepsTheCreasesOfACube) {
    const TriangleMesh before = with_noise(cube(), 0.2);
    NoiseParameters none;
    none.crease_angle = 0;
    expect_halved(denoised(before), denoised(before, none), cube());
    // A tenth of the triangles are at an edge of the cube.
    EXPECT_GE(report_of(before).crease_share, 0.1);
    EXPECT_EQ(report_of(before, none).crease_share, 0);
}

TEST(RemoveNoise, KeepsTheCreasesOfACubeWhoseLongWavesItRemoves) {
    const TriangleMesh before = with_noise(cube(), 0.2);
    for (const double edges : {12, 20, 30}) {
        NoiseParameters parameters;
        parameters.detail_size = edges * mean_edge_length(before);
        expect_halved(denoised(before, parameters), before, cube());
    }
}

TEST(RemoveNoise, KeepsTheBitsOfVerticesThatStay) {
    TriangleMesh mesh = with_noise(shapes::square(20), 0.2);
    NoiseParameters parameters;
    parameters.boundary = NoiseBoundary::Locked;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    mesh.positions.emplace_back(nan, 1, -0.0);  // in no triangle
    std::vector<double> strength(mesh.positions.size(), 1);
    strength[220] = 0;
    Selection selection(mesh.triangles.size(), 1);
    std::fill(selection.begin() + 600, selection.end(), std::uint8_t{0});
    std::vector<std::uint8_t> stays(mesh.positions.size(), 0);
    stays[220] = 1;
    stays.back() = 1;
    for (std::size_t i = 600; i < selection.size(); ++i) {
        for (const std::int32_t vertex : mesh.triangles[i]) stays[vertex] = 1;
    }
    for (std::size_t i = 0; i + 1 < stays.size(); ++i) {
        const Eigen::Vector3d& p = mesh.positions[i];
        if (std::min(p[0], p[1]) == 0 || std::max(p[0], p[1]) == 1) stays[i] = 1;
    }
    const TriangleMesh before = mesh;
    const NoiseReport report = remove_noise(mesh, {selection, strength}, parameters);
    EXPECT_GT(report.rms_displacement, 0);
    std::size_t moved = 0;
    for (std::size_t i = 0; i < stays.size(); ++i) {
        const bool both_nan = mesh.positions[i].hasNaN() && before.positions[i].hasNaN();
        const bool same = both_nan || same_bits(mesh.positions[i], before.positions[i]);
        EXPECT_TRUE(same || stays[i] == 0) << i;
        if (!same) ++moved;
    }
    EXPECT_GT(moved, 100U);
}

TEST(RemoveNoise, MovesAFreeBoundary) {
    const TriangleMesh before = with_noise(shapes::square(20), 0.2);
    EXPECT_NE(denoised(before).positions[0][2], before.positions[0][2]);
}

TEST(RemoveNoise, FollowsTheStrength) {
    TriangleMesh mesh = with_noise(shapes::geodesic_sphere(20), 0.2);
    double last = 0;
    for (const double strength : {0.1, 0.2, 0.5, 1.0}) {
        const std::vector<double> strengths(mesh.positions.size(), strength);
        NoiseParameters parameters;
        parameters.detail_size = 5 * mean_edge_length(mesh);
        TriangleMesh moving = mesh;
        const double moved = remove_noise(moving, {{}, strengths}, parameters).rms_displacement;
        EXPECT_GT(moved, last);
        last = moved;
    }
}

TEST(RemoveNoise, MovesNoVertexFartherThanItsBound) {
    const TriangleMesh before = with_noise(cube(), 0.3);
    for (const double bound : {1e-3, 0.7e-2, 1e-9}) {
        NoiseParameters parameters;
        parameters.largest_movement = bound;
        TriangleMesh mesh = before;
        const NoiseReport report = remove_noise(mesh, {}, parameters);
        EXPECT_GT(report.bounded_vertices, 0);
        double largest = 0;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            largest = std::max(largest, (mesh.positions[i] - before.positions[i]).norm());
        }
        EXPECT_LE(largest, bound);
        EXPECT_GT(largest, 0.999 * bound);
        EXPECT_EQ(report.largest_displacement, largest);
    }
}

TEST(RemoveNoise, KeepsTheBoundWhenItsHostRoundsToFloats) {
    TriangleMesh before = with_noise(cube(), 0.3);
    before.single_precision = true;
    using Floats = std::vector<Eigen::Vector3f>;
    const auto floats = [](const TriangleMesh& mesh) {
        Floats rounded;
        for (const Eigen::Vector3d& p : mesh.positions) rounded.push_back(p.cast<float>());
        return rounded;
    };
    const Floats from = floats(before);
    for (std::size_t i = 0; i < from.size(); ++i) before.positions[i] = from[i].cast<double>();
    for (const double bound : {1e-2, 1e-5, 1e-9}) {
        NoiseParameters parameters;
        parameters.largest_movement = bound;
        TriangleMesh mesh = before;
        remove_noise(mesh, {}, parameters);
        const Floats to = floats(mesh);
        for (std::size_t i = 0; i < from.size(); ++i) {
            ASSERT_LE((to[i].cast<double>() - from[i].cast<double>()).norm(), bound) << i;
        }
    }
}

TEST(RemoveNoise, HalvesWavesOfTheDetailSize) {
    // A sheared square consists of equilateral triangles: all sides have the same length.
    constexpr int side = 120;
    TriangleMesh mesh = shapes::square(side);
    const std::size_t middle = mesh.positions.size() / 2;
    const double length = 30.0 / side;
    for (Eigen::Vector3d& p : mesh.positions) {
        p = {p[0] - p[1] / 2, std::sqrt(0.75) * p[1], 0};
    }
    const double crest = mesh.positions[middle][0];
    for (Eigen::Vector3d& p : mesh.positions) {
        p[2] = 1e-4 * std::cos(2 * std::acos(-1.0) / length * (p[0] - crest));
    }
    ASSERT_NEAR(mean_edge_length(mesh), 1.0 / side, 1e-4 / side);
    NoiseParameters parameters;
    parameters.detail_size = length;
    ASSERT_NEAR(mesh.positions[middle][2], 1e-4, 1e-10);
    // The cotangents err by the square of the wave number times the edge.
    const double angle = 2 * std::acos(-1.0) / (side * length);
    EXPECT_NEAR(denoised(mesh, parameters).positions[middle][2], 0.5e-4, angle * angle * 0.5e-4);
    EXPECT_NEAR(report_of(mesh, parameters).detail_size, parameters.detail_size,
                1e-9 * parameters.detail_size);
}

TEST(RemoveNoise, ReportsTheDetailSizeThatItIsGiven) {
    NoiseParameters parameters;
    parameters.detail_size = 0.7;
    const NoiseReport report = report_of(with_noise(shapes::geodesic_sphere(8), 0.1), parameters);
    EXPECT_GT(report.smoothing_steps, 0);
    EXPECT_NEAR(report.detail_size, parameters.detail_size, 1e-6);
}

TEST(RemoveNoise, TakesTheNoiseItIsTold) {
    const TriangleMesh clean = shapes::geodesic_sphere(20), before = with_noise(clean, 0.2);
    const double edge = mean_edge_length(clean);
    NoiseParameters parameters;
    double last = 0;
    for (const double noise : {0.05, 0.1, 0.2}) {
        parameters.noise = noise * edge;
        const NoiseReport report = report_of(before, parameters);
        EXPECT_NEAR(report.noise / (0.2 * edge), 1, five_errors(clean)) << "the noise that it has";
        EXPECT_GT(report.rms_displacement, last);
        last = report.rms_displacement;
    }
    parameters.noise = 1e-12 * edge;
    const NoiseReport report = report_of(before, parameters);
    EXPECT_EQ(report.stop, NoiseStop::NoNoise) << "any smoothing moves vertices farther";
    EXPECT_EQ(report.largest_displacement, 0);
}

TEST(RemoveNoise, ReportsTheNoiseWhateverIsAskedFor) {
    const TriangleMesh before = with_noise(shapes::geodesic_sphere(20), 0.2);
    const double edge = mean_edge_length(before);
    const double noise = report_of(before).noise;
    for (const double angle : {0.0, 0.5, 40.0}) {
        for (const double detail : {0.0, 1e200}) {
            NoiseParameters parameters;
            parameters.crease_angle = angle;
            parameters.detail_size = detail * edge;
            EXPECT_EQ(report_of(before, parameters).noise, noise) << angle << ' ' << detail;
        }
    }
}

TEST(RemoveNoise, SaysThatSmallCreasesCannotBeToldFromNoise) {
    const TriangleMesh before = with_noise(shapes::geodesic_sphere(20), 0.2);
    NoiseParameters parameters;
    parameters.crease_angle = 0.5;
    const NoiseReport report = report_of(before, parameters);
    EXPECT_EQ(report.stop, NoiseStop::TooManyCreases);
    EXPECT_GT(report.median_turn, 2 * parameters.crease_angle);
    EXPECT_GT(report.crease_share, 0.5) << "a triangle has three sides, half of which turn more";
    EXPECT_EQ(report.detail_size, 0);
    parameters.crease_angle = 1.5 * report.median_turn;
    EXPECT_EQ(report_of(before, parameters).stop, NoiseStop::None);
}

TEST(RemoveNoise, ReportsTheDetailThatItRemoved) {
    const TriangleMesh before = with_noise(shapes::geodesic_sphere(20), 0.2);
    NoiseParameters parameters;
    parameters.detail_size = 10 * mean_edge_length(before);
    EXPECT_NEAR(report_of(before, parameters).detail_size, parameters.detail_size,
                1e-9 * parameters.detail_size);
    parameters.detail_size = 1e200;
    const NoiseReport report = report_of(before, parameters);
    EXPECT_NEAR(report.detail_size, 250 * mean_edge_length(before), 1e-9) << "the largest size";
    EXPECT_GT(report.largest_displacement, 0);
}

TEST(RemoveNoise, ReportsWhatItHasDone) {
    TriangleMesh mesh = with_noise(shapes::geodesic_sphere(20), 0.2);
    const TriangleMesh before = mesh;
    NoiseParameters parameters;
    parameters.quality = Quality::Displacement;
    const NoiseReport report = remove_noise(mesh, {}, parameters);
    EXPECT_EQ(report.vertices, 4002);
    EXPECT_EQ(report.triangles, 8000);
    EXPECT_EQ(report.held_vertices, 0);
    EXPECT_NEAR(report.volume_change, shapes::volume(mesh) - shapes::volume(before), 1e-12);
    EXPECT_NEAR(report.volume_before, shapes::volume(before), 1e-12);
    EXPECT_NEAR(report.area_before, surface_area(before), 1e-12);
    EXPECT_NEAR(report.area_after, surface_area(mesh), 1e-12);
    EXPECT_LT(report.area_after, report.area_before);
    ASSERT_EQ(report.quality.size(), mesh.positions.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_LE(std::abs(report.quality[i]),
                  (1 + 1e-9) * (mesh.positions[i] - before.positions[i]).norm());
    }
}

TEST(RemoveNoise, LeavesTheMeshIfItIsCancelledAtAnyCall) {
    expect_unchanged_if_cancelled(
        with_noise(shapes::box(8, {1, 1, 1}), 0.2),
        [](TriangleMesh& mesh, const Progress& progress) { remove_noise(mesh, {}, {}, progress); });
}

TEST(RemoveNoise, RefusesWhatItCannotDo) {
    TriangleMesh mesh = cube();
    const TriangleMesh before = mesh;
    EXPECT_THROW(remove_noise(mesh, Selection(3, 1), {}), InvalidParameter);
    EXPECT_THROW(remove_noise(mesh, Selection(mesh.triangles.size(), 0), {}), InvalidMesh);
    EXPECT_TRUE(same_bits(mesh, before));
    TriangleMesh point{{{1, 2, 3}}, {{0, 0, 0}}};
    EXPECT_THROW(remove_noise(point, {}, {}), InvalidMesh);
    TriangleMesh points{{{0, 0, 0}, {1, 1, 1}}, {{0, 0, 0}, {1, 1, 1}}};
    EXPECT_THROW(remove_noise(points, {}, {}), InvalidMesh);
    TriangleMesh empty;
    EXPECT_THROW(remove_noise(empty, {}, {}), InvalidMesh);
    TriangleMesh line = shapes::square(10);
    for (Eigen::Vector3d& p : line.positions) p[1] = 0;
    EXPECT_THROW(remove_noise(line, {}, {}), InvalidMesh);
    TriangleMesh huge = shapes::square(10);
    for (Eigen::Vector3d& p : huge.positions) p *= 1e61;
    EXPECT_THROW(remove_noise(huge, {}, {}), InvalidMesh);
    // Floats near 1e6 are multiples of 1/16.
    TriangleMesh far =
        shapes::transformed(before, Eigen::Affine3d(Eigen::Translation3d(1e6, 0, 0)));
    far.single_precision = true;
    NoiseParameters parameters;
    parameters.largest_movement = 0.01;
    EXPECT_THROW(remove_noise(far, {}, parameters), InvalidParameter);
    parameters.largest_movement = 0.1;
    EXPECT_NO_THROW(remove_noise(far, {}, parameters));
}

TEST(RemoveNoise, NothingFliesAway) {
    // The first step that a length beyond the mesh asks for would throw a thin strip out of its
    // box.
    TriangleMesh strip = shapes::square(10);
    for (Eigen::Vector3d& p : strip.positions) {
        p = {p[0], 1.68e-4 * p[1], 0.3 * std::sin(9 * p[0])};
    }
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : strip.positions) box.extend(p);
    NoiseParameters parameters;
    parameters.detail_size = 64.6;
    remove_noise(strip, {}, parameters);
    const double margin = 0.1 * std::sqrt(3.0) * box.diagonal().norm();
    for (const Eigen::Vector3d& p : strip.positions) EXPECT_LE(box.exteriorDistance(p), margin);
}

TEST(RemoveNoise, IsDefinedForBadMeshes) {
    TriangleMesh collapsed = shapes::square(10);
    for (std::size_t i = 0; i < 60; ++i) collapsed.positions[i] = collapsed.positions[0];
    const TriangleMesh triangle{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
    const TriangleMesh two{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}}, {{0, 1, 2}, {2, 1, 3}}};
    const TriangleMesh copies = shapes::stack(shapes::square(10), 3, 0);
    for (const TriangleMesh& mesh : {collapsed, triangle, two, copies, shapes::fan(1000),
                                     shapes::moebius_band(30, 4), shapes::separate_triangles(200),
                                     with_noise(shapes::stack(shapes::square(10), 3, 1e-9), 1)}) {
        for (const double crease_angle : {0.0, 25.0}) {
            for (const NoiseBoundary boundary :
                 {NoiseBoundary::Locked, NoiseBoundary::Free, NoiseBoundary::Smooth}) {
                NoiseParameters parameters;
                parameters.crease_angle = crease_angle;
                parameters.boundary = boundary;
                TriangleMesh after = mesh;
                const NoiseReport report = remove_noise(after, {}, parameters);
                EXPECT_TRUE(is_finite(after));
                EXPECT_TRUE(std::isfinite(report.noise));
            }
        }
    }
}

}  // namespace
}  // namespace tracked_mcf
