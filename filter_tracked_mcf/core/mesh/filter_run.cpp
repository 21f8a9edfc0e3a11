// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/mesh/filter_run.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/platform/process_memory.h"

namespace tracked_mcf {

namespace {

/// Returns the volume between the selected triangles of a mesh and where they have moved.
double volume_between(const TriangleMesh& before, const std::vector<Eigen::Vector3d>& after,
                      const Selection& selection) {
    return parallel_sum(static_cast<std::int64_t>(before.triangles.size()), 0.0,
                        [&](std::int64_t begin, std::int64_t end) {
                            double sum = 0;
                            for (std::int64_t i = begin; i < end; ++i) {
                                if (!selection.empty() && selection[i] == 0) continue;
                                const Triangle& triangle = before.triangles[i];
                                sum += swept_volume(corners_of(before.positions, triangle),
                                                    corners_of(after, triangle));
                            }
                            return sum;
                        });
}

void report_displacements(const TriangleMesh& before, const std::vector<Eigen::Vector3d>& after,
                          const std::vector<std::uint8_t>& counted, FilterReport& report) {
    double largest = 0, squares = 0, count = 0;
    for (std::size_t i = 0; i < after.size(); ++i) {
        if (counted[i] == 0) continue;
        const double square = (after[i] - before.positions[i]).squaredNorm();
        squares += square;
        largest = std::max(largest, square);
        ++count;
    }
    report.largest_displacement = std::sqrt(largest);
    report.rms_displacement = count > 0 ? std::sqrt(squares / count) : 0;
}

}  // namespace

MovingPart moving_part_of(const Domain& domain) {
    return {domain.selection(), one_copy_of_each_vertex(domain.topology()),
            domain.topology().is_oriented_consistently(), domain.encloses_volume()};
}

void report_domain(const Domain& domain, SmoothingReport& report) {
    report.triangles = static_cast<std::int64_t>(domain.surface().triangles.size());
    report.degenerate_triangles = count_degenerate(domain.surface());
    if (report.degenerate_triangles == report.triangles)
        throw InvalidMesh("All faces to be smoothed are degenerate: none has an area.");
    std::tie(report.vertices, report.held_vertices) = domain.vertex_counts();
    report.boundary_edges = domain.boundary_edge_count();
    report.cracks = domain.topology().cracks;
}

void report_change(const TriangleMesh& before, const std::vector<Eigen::Vector3d>& after,
                   const MovingPart& part, Quality quality, FilterReport& report) {
    report_displacements(before, after, part.vertices, report);
    report.area_before = surface_area(before, part.triangles);
    report.area_after = surface_area({after, before.triangles}, part.triangles);
    if (part.encloses_volume) report.volume_before = enclosed_volume(before);
    if (part.is_oriented) report.volume_change = volume_between(before, after, part.triangles);
    if (quality == Quality::Displacement)
        report.quality = displacements_along_normals(before, after, part.triangles);
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
