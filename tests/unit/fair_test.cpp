// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/fair.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "tests/support/measures.h"
#include "tests/support/shapes.h"
#include "tests/unit/cancelling.h"
#include "tests/unit/fair/filled.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

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
    EXPECT_NEAR(report.area_after, surface_area(part_of(filled.mesh, filled.selection)), 1e-14);
    EXPECT_GT(report.area_after, report.area_before);
    EXPECT_EQ(report.quality.size(), before.positions.size());
    EXPECT_GT(*std::max_element(report.quality.begin(), report.quality.end()), 0);
    EXPECT_EQ(report.flatter_patches, 0);
}

}  // namespace
}  // namespace tracked_mcf
