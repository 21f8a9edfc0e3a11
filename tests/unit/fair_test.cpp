// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/fair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "tests/support/shapes.h"
#include "tests/unit/cancelling.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

using Inside = std::function<bool(const Eigen::Vector3d&)>;
using Distance = std::function<double(const Eigen::Vector3d&)>;

const double kPi = std::acos(-1.0);

/// Selects the triangles with a vertex inside.
Selection star_of(const TriangleMesh& mesh, const Inside& inside) {
    Selection selection;
    for (const Triangle& t : mesh.triangles) {
        const auto is_inside = [&](std::int32_t vertex) { return inside(mesh.positions[vertex]); };
        selection.push_back(std::any_of(t.begin(), t.end(), is_inside) ? 1 : 0);
    }
    return selection;
}

Inside cap(double degrees) {
    const double height = std::cos(degrees * kPi / 180);
    return [height](const Eigen::Vector3d& p) { return p[2] > height; };
}

FairParameters with(Continuity continuity) {
    FairParameters parameters;
    parameters.continuity = continuity;
    return parameters;
}

/// A mesh, part of which is replaced by its membrane, as if a hole had been filled.
struct Filled {
    Filled(const TriangleMesh& original, const Inside& inside)
        : mesh(original), selection(star_of(original, inside)) {
        fair(mesh, selection, with(Continuity::Position));
    }

    TriangleMesh mesh;
    Selection selection;
};

/// Returns the largest distance from a shape after fairing.
double error(Filled filled, Continuity continuity, const Distance& distance) {
    fair(filled.mesh, filled.selection, with(continuity));
    double largest = 0;
    for (const Eigen::Vector3d& p : filled.mesh.positions) {
        largest = std::max(largest, std::abs(distance(p)));
    }
    return largest;
}

double from_sphere(const Eigen::Vector3d& p) {
    return p.norm() - 1;
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

std::string refusal(TriangleMesh mesh, const Selection& selection) {
    const TriangleMesh before = mesh;
    try {
        fair(mesh, selection, {});
    } catch (const InvalidMesh& invalid) {
        EXPECT_TRUE(same_bits(mesh, before));
        return invalid.what();
    }
    return "none";
}

void expect_contains(const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
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

TEST(Fair, MissesASphereByTheFourthOrTheSixthPowerOfTheSizeOfAHole) {
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

TEST(Fair, ContinuesACylinderAndATorus) {
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

TEST(Fair, KeepsAPlaneFlat) {
    TriangleMesh square = shapes::square(20);
    const Selection selection = star_of(square, [](const Eigen::Vector3d& p) {
        return (p - Eigen::Vector3d(0.5, 0.5, 0)).norm() < 0.3;
    });
    for (const Continuity continuity :
         {Continuity::Position, Continuity::Tangent, Continuity::Curvature}) {
        const FairReport report = fair(square, selection, with(continuity));
        for (const Eigen::Vector3d& position : square.positions) EXPECT_EQ(position[2], 0);
        EXPECT_EQ(report.rough_patches, 0);
    }
}

TEST(Fair, KeepsTheBitsOfAllButTheInnerVerticesOfTheSelection) {
    const Filled filled(shapes::bumpy_sphere(20), cap(40));
    TriangleMesh mesh = filled.mesh;
    std::set<std::int32_t> outside;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        if (filled.selection[i] == 0)
            outside.insert(mesh.triangles[i].begin(), mesh.triangles[i].end());
    }
    const FairReport report = fair(mesh, filled.selection, {});
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const bool kept = same_bits(mesh.positions[i], filled.mesh.positions[i]);
        EXPECT_EQ(kept, outside.count(static_cast<std::int32_t>(i)) > 0) << i;
    }
    EXPECT_EQ(report.vertices, static_cast<std::int64_t>(mesh.positions.size() - outside.size()));
    EXPECT_EQ(report.patches, 1);
}

TEST(Fair, KeepsTheSignsOfZerosOfCoincidentVertices) {
    TriangleMesh soup = shapes::soup(shapes::square(10));
    for (Eigen::Vector3d& p : soup.positions) p[2] = -0.0;
    const Selection selection = star_of(soup, [](const Eigen::Vector3d& p) {
        return (p - Eigen::Vector3d(0.5, 0.5, 0)).norm() < 0.25;
    });
    const TriangleMesh before = soup;
    EXPECT_GT(fair(soup, selection, {}).vertices, 0);
    for (std::size_t i = 0; i < soup.triangles.size(); ++i) {
        if (selection[i] != 0) continue;
        for (const std::int32_t vertex : soup.triangles[i])
            EXPECT_TRUE(same_bits(soup.positions[vertex], before.positions[vertex])) << vertex;
    }
}

TEST(Fair, HasTheSameBitsForAnyNumberOfThreads) {
    const Filled filled(shapes::bumpy_sphere(20), cap(40));
    FairParameters parameters;
    parameters.threads = 1;
    TriangleMesh first = filled.mesh;
    fair(first, filled.selection, parameters);
    for (const int threads : {2, 3, 8}) {
        parameters.threads = threads;
        TriangleMesh mesh = filled.mesh;
        fair(mesh, filled.selection, parameters);
        EXPECT_TRUE(same_bits(mesh, first)) << threads;
    }
}

TEST(Fair, TurnsAndScalesWithTheMesh) {
    const Filled filled(shapes::bumpy_sphere(20), cap(40));
    TriangleMesh mesh = filled.mesh;
    const FairReport report = fair(mesh, filled.selection, {});
    const Eigen::Affine3d turn(Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()));
    for (const double scale : {1.0, 1e-50, 1e50}) {
        const Eigen::Affine3d moved = turn * Eigen::Scaling(scale);
        TriangleMesh other = shapes::transformed(filled.mesh, moved);
        const FairReport of_other = fair(other, filled.selection, {});
        EXPECT_LT(distance(other, shapes::transformed(mesh, moved)), 1e-9 * scale);
        EXPECT_NEAR(of_other.seam_curvature * scale, report.seam_curvature, 1e-9);
        EXPECT_NEAR(of_other.height, report.height, 1e-9);
    }
}

TEST(Fair, DoesNotDependOnOrientationOrWelding) {
    const Filled filled(shapes::bumpy_sphere(12), cap(40));
    TriangleMesh mesh = filled.mesh;
    fair(mesh, filled.selection, {});
    TriangleMesh other = filled.mesh;
    for (std::size_t i = 0; i < other.triangles.size(); i += 3) {
        std::swap(other.triangles[i][0], other.triangles[i][1]);
    }
    fair(other, filled.selection, {});
    EXPECT_LT(distance(mesh, other), 1e-9);
    TriangleMesh soup = shapes::soup(filled.mesh);
    fair(soup, filled.selection, {});
    EXPECT_LT(distance(soup, shapes::soup(mesh)), 1e-9);
}

TEST(Fair, TellsRoughSurroundingsFromSmoothOnes) {
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

TEST(Fair, EndsWhenTheShapeIsFinal) {
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

TEST(Fair, TakesTheCurvatureOfSmoothSurroundings) {
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

TEST(Fair, TakesNoMoreContinuityThanItsSurroundingsTell) {
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

TEST(Fair, KeepsTheRimOfAnOpenMesh) {
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

TEST(Fair, TakesSeveralPatchesThatMayTouch) {
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

TEST(Fair, TakesBadTriangles) {
    TriangleMesh mesh = shapes::geodesic_sphere(16);
    const Selection selection = star_of(mesh, cap(30));
    for (Eigen::Vector3d& position : mesh.positions) {
        if (cap(30)(position)) position = {1e-7 * position[0], std::pow(position[1], 3), 0.5};
    }
    fair(mesh, selection, {});
    // The middle of the patch was 0.5 away. At least half of that must go.
    for (const Eigen::Vector3d& p : mesh.positions) EXPECT_LT(std::abs(from_sphere(p)), 0.25);
}

TEST(Fair, TakesTrianglesWhoseSquaredSidesUnderflow) {
    TriangleMesh mesh = shapes::geodesic_sphere(10);
    for (Eigen::Vector3d& p : mesh.positions) {
        if (cap(60)(p)) p *= 1e-300;
    }
    const FairReport report =
        fair(mesh, star_of(mesh, [](const Eigen::Vector3d& p) { return p.norm() < 1e-200; }), {});
    EXPECT_GT(report.vertices, 0);
    EXPECT_TRUE(std::isfinite(report.patch_curvature) && std::isfinite(report.seam_curvature));
}

TEST(Fair, TakesSeamsWhereMoreThanTwoFacesMeet) {
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

TEST(Fair, StaysNearTheMembraneInRoughSurroundings) {
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

TEST(Fair, RefusesWhatItCannotContinue) {
    const TriangleMesh sphere = shapes::geodesic_sphere(8);
    const std::size_t count = sphere.triangles.size();
    expect_contains(refusal(sphere, Selection(count, 0)), "No face is selected");
    expect_contains(refusal(sphere, Selection(count, 1)), "nothing around");
    expect_contains(refusal(sphere, {}), "nothing around");
    Selection first(2 * count, 0);
    std::fill(first.begin(), first.begin() + static_cast<std::ptrdiff_t>(count), std::uint8_t{1});
    const Eigen::Affine3d aside(Eigen::Translation3d(3, 0, 0));
    const TriangleMesh two = shapes::merged(sphere, shapes::transformed(sphere, aside));
    expect_contains(refusal(two, first), "Nothing holds");
    // The other sphere touches it in one vertex.
    TriangleMesh touching = two;
    touching.positions[sphere.positions.size()] = touching.positions[0];
    expect_contains(refusal(touching, first), "Nothing holds");

    TriangleMesh mesh = sphere;
    Selection one(count, 0);
    one[0] = 1;
    EXPECT_THROW(fair(mesh, Selection(3, 1), {}), InvalidParameter);
    mesh.positions[0][0] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(fair(mesh, one, {}), InvalidMesh);
}

TEST(Fair, MovesNothingWithoutInnerVertices) {
    const TriangleMesh sphere = shapes::geodesic_sphere(8);
    Selection one(sphere.triangles.size(), 0);
    one[0] = 1;
    TriangleMesh mesh = sphere;
    const FairReport report = fair(mesh, one, {});
    EXPECT_EQ(report.patches, 0);
    EXPECT_EQ(report.vertices, 0);
    EXPECT_EQ(report.triangles, 1);
    EXPECT_EQ(report.largest_displacement, 0);
    EXPECT_EQ(report.volume_change, 0);
    EXPECT_EQ(mesh.positions, sphere.positions);
}

TEST(Fair, ReportsTheVolumeThatItsPatchesSweep) {
    const Filled filled(shapes::geodesic_sphere(10), cap(40));
    TriangleMesh mesh = filled.mesh;
    const FairReport report = fair(mesh, filled.selection, {});
    const double change = enclosed_volume(mesh) - enclosed_volume(filled.mesh);
    EXPECT_NEAR(report.volume_change, change, 1e-12);
    EXPECT_GT(std::abs(change), 1e-3);
    EXPECT_TRUE(std::isnan(report.volume_before)) << "not all of the mesh may move";
}

TEST(Fair, LeavesTheMeshIfItIsCancelledAtAnyCall) {
    const Filled filled(shapes::geodesic_sphere(10), cap(40));
    expect_unchanged_if_cancelled(filled.mesh, [&](TriangleMesh& mesh, const Progress& progress) {
        fair(mesh, filled.selection, {}, progress);
    });
}

TEST(Fair, ReportsTheMovement) {
    Filled filled(shapes::geodesic_sphere(10), cap(40));
    const TriangleMesh before = filled.mesh;
    FairParameters parameters;
    parameters.quality = Quality::Displacement;
    const FairReport report = fair(filled.mesh, filled.selection, parameters);
    EXPECT_DOUBLE_EQ(report.largest_displacement, distance(filled.mesh, before));
    EXPECT_DOUBLE_EQ(report.area_after, surface_area(filled.mesh, filled.selection));
    EXPECT_GT(report.area_after, report.area_before);
    EXPECT_EQ(report.quality.size(), before.positions.size());
    EXPECT_GT(*std::max_element(report.quality.begin(), report.quality.end()), 0);
    EXPECT_EQ(report.flatter_patches, 0);
}

}  // namespace
}  // namespace tracked_mcf
