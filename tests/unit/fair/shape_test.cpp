// SPDX-License-Identifier: GPL-3.0-or-later
// What shape fair() gives a patch, beside the shape around it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "tests/support/shapes.h"
#include "tests/unit/fair/filled.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

using Distance = std::function<double(const Eigen::Vector3d&)>;

const double kPi = std::acos(-1.0);

/// Returns the largest distance from a shape after fairing.
double error(Filled filled, Continuity continuity, const Distance& distance) {
    fair(filled.mesh, filled.selection, with(continuity));
    double largest = 0;
    for (const Eigen::Vector3d& p : filled.mesh.positions) {
        largest = std::max(largest, std::abs(distance(p)));
    }
    return largest;
}

double from_cylinder(const Eigen::Vector3d& p) {
    return std::hypot(p[0], p[1]) - 1;
}

double from_torus(const Eigen::Vector3d& p) {
    return std::hypot(std::hypot(p[0], p[1]) - 1, p[2]) - 0.4;
}

/// Moves the vertices of a sphere along their normals.
TriangleMesh roughened(TriangleMesh sphere, double size) {
    for (std::size_t i = 0; i < sphere.positions.size(); ++i) {
        sphere.positions[i] *= 1 + size * std::sin(1e4 * static_cast<double>(i));
    }
    return sphere;
}

/// Returns the RMS distance from a sphere of the vertices that were inside.
double rms_error(const TriangleMesh& mesh, const TriangleMesh& sphere, const Inside& inside) {
    double squares = 0, count = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (!inside(sphere.positions[i])) continue;
        squares += std::pow(from_sphere(mesh.positions[i]), 2);
        ++count;
    }
    return std::sqrt(squares / count);
}

/// Returns a bound of how far a patch is from a shape, to leading order in the size of the patch.
///
/// The difference e is a plate that is clamped at the rim of the patch: Δ² e, for curvature Δ³ e,
/// is that of the shape's height over its tangent plane. The strip of the patch's width has the
/// largest e: load sⁿ / n! in its middle, for half the width s and n = 4 or 6.
double of_strip(double load, double half_width, int n) {
    return load * std::pow(half_width, n) / std::tgamma(n + 1);
}

/// The height of the unit cylinder, 1 - (1 - y²)^½, has the terms y⁴ / 8 and y⁶ / 16.
double of_cylinder(double half_width, int n) {
    return of_strip(n == 4 ? 3 : 45, half_width, n);
}

/// The same for a cap of the unit sphere, whose height has the terms r⁴ / 8 and r⁶ / 16. On a disc
/// of radius a, the error is (a² - r²)² / 8, or (a² - r²)³ / 16 for curvature: largest in the
/// middle.
double of_cap(double degrees, int n) {
    return std::pow(degrees * kPi / 180, n) / (n == 4 ? 8 : 16);
}

TEST(FairedShape, MissesASphereByTheFourthOrTheSixthPowerOfTheSizeOfAHole) {
    const TriangleMesh sphere = shapes::geodesic_sphere(30);
    std::vector<double> tangents, curvatures;
    for (const double degrees : {30, 60}) {
        const Filled filled(sphere, cap(degrees));
        tangents.push_back(error(filled, Continuity::Tangent, from_sphere));
        curvatures.push_back(error(filled, Continuity::Curvature, from_sphere));
        EXPECT_LT(tangents.back(), of_cap(degrees, 4));
        EXPECT_LT(curvatures.back(), of_cap(degrees, 6));
    }
    EXPECT_NEAR(std::log2(tangents[1] / tangents[0]), 4, 0.5);
    // The error of the mesh adds to the smaller patch's.
    EXPECT_NEAR(std::log2(curvatures[1] / curvatures[0]), 6, 1);
}

TEST(FairedShape, ContinuesACylinderAndATorus) {
    // The rim of the selection is a ring of edges farther away.
    const TriangleMesh tube = shapes::tube(48, 32, 4);
    const Filled side(tube,
                      [](const Eigen::Vector3d& p) { return p[0] > 0.2 && std::abs(p[2]) < 0.7; });
    const Filled ring(tube, [](const Eigen::Vector3d& p) { return std::abs(p[2]) < 0.7; });
    for (const Filled& filled : {side, ring}) {
        EXPECT_LT(error(filled, Continuity::Tangent, from_cylinder), of_cylinder(0.75, 4));
        EXPECT_LT(error(filled, Continuity::Curvature, from_cylinder), of_cylinder(0.75, 6));
    }
    // The larger curvature of the torus is that of a cylinder of radius 0.4. The other one has less
    // than a tenth of its third power.
    const Filled torus(shapes::torus(160, 80, 1, 0.4),
                       [](const Eigen::Vector3d& p) { return p[0] > 0.9 && std::abs(p[1]) < 0.2; });
    const double half_width = 0.2 + 1.4 * 2 * kPi / 160;
    EXPECT_LT(error(torus, Continuity::Tangent, from_torus),
              1.1 * 0.4 * of_cylinder(half_width / 0.4, 4));
    EXPECT_LT(error(torus, Continuity::Curvature, from_torus),
              1.1 * 0.4 * of_cylinder(half_width / 0.4, 6));
}

TEST(FairedShape, TellsRoughSurroundingsFromSmoothOnes) {
    const TriangleMesh sphere = shapes::geodesic_sphere(20);
    Filled smooth(sphere, cap(30));
    const FairReport of_smooth = fair(smooth.mesh, smooth.selection, {});
    EXPECT_EQ(of_smooth.rough_patches, 0);
    EXPECT_NEAR(of_smooth.seam_curvature, 1, std::pow(mean_edge_length(sphere), 2));
    // The plate (a² - r²)² / 8 adds r² - a² / 2 to the curvature, with RMS a² / √12.
    const double radius = 30 * kPi / 180;
    EXPECT_NEAR(of_smooth.patch_curvature, 1, radius * radius / std::sqrt(12));
    // Around a patch that rises by much less than the noise's slope, chance alone raises it.
    TriangleMesh square = shapes::square(20);
    for (std::size_t i = 0; i < square.positions.size(); ++i)
        square.positions[i][2] = 0.01 * std::sin(1e4 * static_cast<double>(i));
    const auto middle = [](const Eigen::Vector3d& p) {
        return std::hypot(p[0] - 0.5, p[1] - 0.5) < 0.3;
    };
    const Filled noisy(square, middle);
    TriangleMesh tangent = noisy.mesh;
    EXPECT_EQ(fair(tangent, noisy.selection, {}).rough_patches, 1);
    const auto squared_heights = [&](const TriangleMesh& mesh) {
        double sum = 0;
        for (const Eigen::Vector3d& p : mesh.positions) sum += middle(p) ? p[2] * p[2] : 0;
        return sum;
    };
    EXPECT_GT(squared_heights(tangent), squared_heights(noisy.mesh));
    // A patch that rises more is at least twice as good as its membrane in spite of noise.
    const Filled deeper(roughened(sphere, 0.01), cap(30));
    tangent = deeper.mesh;
    EXPECT_EQ(fair(tangent, deeper.selection, {}).rough_patches, 0);
    EXPECT_LT(rms_error(tangent, sphere, cap(30)), 0.5 * rms_error(deeper.mesh, sphere, cap(30)));
}

TEST(FairedShape, EndsWhenTheShapeIsFinal) {
    // A pass that changes the shape by less than 5e-4 of the hole's diameter, which is 1, is the
    // last. Further ones only slide the vertices along the sphere.
    const Filled filled(shapes::geodesic_sphere(24), cap(30));
    TriangleMesh mesh = filled.mesh;
    const FairReport report = fair(mesh, filled.selection, with(Continuity::Tangent));
    EXPECT_LT(report.passes, 5) << "the most that it makes";
    TriangleMesh again = mesh;
    fair(again, filled.selection, {});
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_NEAR(again.positions[i].norm(), mesh.positions[i].norm(), 5e-4) << i;
    }
}

TEST(FairedShape, TakesTheCurvatureOfSmoothSurroundings) {
    const TriangleMesh sphere = shapes::geodesic_sphere(24);
    for (const double degrees : {15, 30, 60, 90, 120}) {
        Filled filled(sphere, cap(degrees));
        const FairReport report = fair(filled.mesh, filled.selection, with(Continuity::Curvature));
        EXPECT_EQ(report.flatter_patches, 0) << degrees;
        EXPECT_EQ(report.rough_patches, 0) << degrees;
    }
}

/// Moves a third of the vertices outside close to one of their neighbours, along the surface.
TriangleMesh with_needles(TriangleMesh mesh, const Inside& inside, double distance) {
    const std::vector<Eigen::Vector3d> before = mesh.positions;
    for (const Triangle& t : mesh.triangles) {
        if (t[0] % 3 != 0 || inside(before[t[0]])) continue;
        mesh.positions[t[0]] = before[t[1]] + distance * (before[t[0]] - before[t[1]]);
    }
    return mesh;
}

TEST(FairedShape, TakesNoMoreContinuityThanItsSurroundingsTell) {
    const TriangleMesh sphere = shapes::geodesic_sphere(30);
    const double edge = mean_edge_length(sphere);
    for (const double degrees : {30, 60}) {
        const TriangleMesh noisy = roughened(sphere, 0.5 * edge);
        const TriangleMesh needles = with_needles(sphere, cap(degrees + 1), 1e-4);
        for (const TriangleMesh& bad : {noisy, needles}) {
            const Filled filled(bad, cap(degrees));
            TriangleMesh tangent = filled.mesh, curvature = filled.mesh;
            EXPECT_EQ(fair(tangent, filled.selection, {}).flatter_patches, 0);
            const FairReport report =
                fair(curvature, filled.selection, with(Continuity::Curvature));
            EXPECT_EQ(report.flatter_patches, 1);
            EXPECT_TRUE(same_bits(tangent, curvature));
            EXPECT_LT(rms_error(tangent, sphere, cap(degrees)),
                      rms_error(filled.mesh, sphere, cap(degrees)));
        }
    }
}

TEST(FairedShape, KeepsTheRimOfAnOpenMesh) {
    // The upper half of a cylinder's side, up to its rim.
    const TriangleMesh tube = shapes::tube(48, 32, 4);
    const Inside upper = [](const Eigen::Vector3d& p) { return p[2] > 1; };
    const Selection selection = star_of(tube, upper);
    TriangleMesh mesh = tube;
    fair(mesh, selection, {});
    // The rim keeps its place and has no curvature. A plate of length 1 that is hinged there misses
    // the cylinder by 3 / 185, and by 1 / 27 because the cylinder does have its curvature there.
    constexpr double hinged = 3.0 / 185 + 1.0 / 27;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const bool moves = upper(tube.positions[i]) && tube.positions[i][2] < 1.999;
        EXPECT_EQ(same_bits(mesh.positions[i], tube.positions[i]), !moves) << i;
        EXPECT_LT(std::abs(from_cylinder(mesh.positions[i])), hinged);
    }
}

TEST(FairedShape, TakesSeveralPatchesThatMayTouch) {
    const TriangleMesh sphere = shapes::geodesic_sphere(30);
    const double degrees = std::acos(0.9) * 180 / kPi;
    const Inside poles = [](const Eigen::Vector3d& p) { return std::abs(p[2]) > 0.9; };
    Filled far(sphere, poles);
    EXPECT_EQ(fair(far.mesh, far.selection, {}).patches, 2);
    EXPECT_LT(error(far, Continuity::Tangent, from_sphere), of_cap(degrees, 4));
    // Two patches with less than a ring of faces between them.
    const Inside pair = [](const Eigen::Vector3d& p) {
        return p[2] > 0.9 && std::abs(p[0]) > 0.03;
    };
    Filled touching(sphere, pair);
    EXPECT_EQ(fair(touching.mesh, touching.selection, {}).patches, 1);
    EXPECT_LT(error(touching, Continuity::Tangent, from_sphere), of_cap(degrees, 4));
}

TEST(FairedShape, TakesSeamsWhereMoreThanTwoFacesMeet) {
    // A wall stands on the seam.
    Filled filled(shapes::geodesic_sphere(20), cap(30));
    const auto count = static_cast<std::int32_t>(filled.mesh.positions.size());
    for (const Eigen::Vector3d& p : std::vector<Eigen::Vector3d>(filled.mesh.positions)) {
        filled.mesh.positions.emplace_back(1.5 * p);
    }
    const std::size_t triangles = filled.selection.size();
    for (std::size_t i = 0; i < triangles; ++i) {
        const Triangle t = filled.mesh.triangles[i];
        if (filled.selection[i] != 0 || filled.mesh.positions[t[0]][2] < 0.6) continue;
        filled.mesh.triangles.push_back({t[0], t[1], t[0] + count});
        filled.selection.push_back(0);
    }
    TriangleMesh mesh = filled.mesh;
    fair(mesh, filled.selection, {});
    for (std::int32_t i = 0; i < count; ++i) {
        EXPECT_LT(mesh.positions[i].norm(), 1 + of_cap(30, 4));
        EXPECT_GT(mesh.positions[i].norm(), std::cos(30 * kPi / 180)) << "the plane of the seam";
    }
}

TEST(FairedShape, StaysNearTheMembraneInRoughSurroundings) {
    const TriangleMesh rough = roughened(shapes::geodesic_sphere(16), 0.2);
    for (const double degrees : {20, 60, 120}) {
        for (const Continuity continuity : {Continuity::Tangent, Continuity::Curvature}) {
            Filled filled(rough, cap(degrees));
            const TriangleMesh membrane = filled.mesh;
            const FairReport report = fair(filled.mesh, filled.selection, with(continuity));
            EXPECT_LE(report.height, 1);
            const double size = 2 * 1.2 * std::sin(std::min(degrees, 90.0) * kPi / 180);
            EXPECT_LE(distance(filled.mesh, membrane), 1.01 * size);
        }
    }
}

}  // namespace
}  // namespace tracked_mcf
