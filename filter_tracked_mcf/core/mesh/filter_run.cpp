// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/filter_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/platform/process_memory.h"

namespace tracked_mcf {

namespace {

/// Returns the sum of body(triangle) over the surface's triangles, as vertices of the mesh.
template <class Body>
double sum_over_triangles(const Surface& surface, const Body& body) {
    return sum_over_rows(static_cast<std::int64_t>(surface.stars.triangles.size()),
                         [&](std::int32_t i) { return body(surface.mesh_triangle(i)); });
}

double area_of(const Surface& surface, const Positions& positions) {
    return sum_over_triangles(surface, [&](const Triangle& t) {
        const auto [a, b, c] = corners_of(positions, t);
        return twice_vector_area(a, b, c).norm() / 2;
    });
}

void report_displacements(const TriangleMesh& before, const Positions& after,
                          const Surface& surface, FilterReport& report) {
    double largest = 0, squares = 0;
    for (const std::int32_t vertex : surface.mesh_vertices) {
        const double square = (after[vertex] - before.positions[vertex]).squaredNorm();
        squares += square;
        largest = std::max(largest, square);
    }
    report.largest_displacement = std::sqrt(largest);
    const auto count = static_cast<double>(report.vertices);
    report.rms_displacement = count > 0 ? std::sqrt(squares / count) : 0;
}

/// Returns how far each vertex of the mesh has moved along the normal of the surface after the
/// movement: the mean of the normals of its triangles, weighted by area.
std::vector<double> displacements_along_normals(const TriangleMesh& before, const Positions& after,
                                                const Surface& surface) {
    Positions normals(surface.mesh_vertices.size(), Eigen::Vector3d::Zero());
    parallel_for_rows(surface.stars.count(), [&](std::int32_t vertex) {
        for_each_corner(surface.stars, vertex, [&](std::uint32_t triangle, std::uint32_t) {
            const auto [a, b, c] = corners_of(after, surface.mesh_triangle(triangle));
            normals[vertex] += twice_vector_area(a, b, c);
        });
        if (!normals[vertex].isZero(0)) normals[vertex].stableNormalize();
    });
    std::vector<double> displacements(after.size(), 0);
    parallel_for_rows(static_cast<std::int64_t>(after.size()), [&](std::int32_t i) {
        const std::int32_t vertex = surface.vertices[i];
        // A vertex that no triangle uses may be a NaN.
        if (vertex >= 0) displacements[i] = normals[vertex].dot(after[i] - before.positions[i]);
    });
    return displacements;
}

}  // namespace

void report_counts(const SurfaceCounts& counts, FilterReport& report) {
    report.triangles = counts.triangles;
    report.degenerate_triangles = counts.degenerate;
    report.copied_triangles = counts.copies;
    report.double_sided_parts = counts.double_sided_parts;
    report.cracks = counts.cracks;
}

void report_surface(const Surface& surface, SmoothingReport& report) {
    report_counts(surface.counts, report);
    report.vertices = surface.stars.count();
    report.held_vertices = std::count(surface.held.begin(), surface.held.end(), 1);
    report.boundary_edges = surface.counts.boundary_edges;
}

void report_change(const TriangleMesh& before, const std::vector<Eigen::Vector3d>& after,
                   const Surface& surface, Quality quality, FilterReport& report) {
    report_displacements(before, after, surface, report);
    report.area_before = area_of(surface, before.positions);
    report.area_after = area_of(surface, after);
    if (surface.is_whole_mesh() && surface.bounds_volume()) {
        // Relative to the middle of the surface, so that one far from the origin loses no digits.
        report.volume_before = sum_over_triangles(surface, [&](const Triangle& t) {
            const auto [a, b, c] = corners_of(before.positions, t);
            return (a - surface.box.center()).dot(twice_vector_area(a, b, c)) / 6;
        });
    }
    if (surface.is_oriented_alike()) {
        report.volume_change = sum_over_triangles(surface, [&](const Triangle& t) {
            return swept_volume(corners_of(before.positions, t), corners_of(after, t));
        });
    }
    if (quality == Quality::Displacement)
        report.quality = displacements_along_normals(before, after, surface);
}

FilterRun::FilterRun(int threads, const Progress& progress) : team_(threads) {
    if (progress) meter_.emplace(progress);
}

void FilterRun::finish(TriangleMesh& mesh, std::vector<Eigen::Vector3d>&& after,
                       FilterReport& report) {
    report.seconds = watch_.seconds();
    report.peak_memory_bytes = peak_memory_bytes();
    enter_phase(1, "Done");
    // Nothing can fail from here on.
    mesh.positions = std::move(after);
}

}  // namespace tracked_mcf
