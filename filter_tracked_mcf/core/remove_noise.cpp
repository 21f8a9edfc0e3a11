// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/remove_noise.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "filter_tracked_mcf/core/mesh/filter_run.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/noise/denoising.h"
#include "filter_tracked_mcf/core/noise/losses.h"
#include "filter_tracked_mcf/core/noise/rim.h"
#include "filter_tracked_mcf/core/platform/process_memory.h"

namespace tracked_mcf {

namespace {

/// Bytes for each vertex and each triangle, besides the mesh.
constexpr double kBytesPerVertex = 450, kBytesPerTriangle = 90;

void check_memory(const TriangleMesh& mesh) {
    check_free_memory(kBytesPerVertex * static_cast<double>(mesh.positions.size()) +
                          kBytesPerTriangle * static_cast<double>(mesh.triangles.size()),
                      "Removing noise", "Simplify the mesh, or take a part of it.");
}

/// Returns the positions of the surface's vertices after they have moved as the parameters ask, and
/// reports how.
Positions without_noise(NoisySurface& surface, double edge, const NoiseParameters& parameters,
                        NoiseReport& report) {
    const ProgressSpan span(0.3, 0.95);
    Positions positions = denoised(surface, edge, parameters, report);
    if (parameters.boundary == NoiseBoundary::Smooth) {
        smooth_rim(surface, crease_of(parameters.crease_angle), confinement(surface.positions),
                   positions);
    }
    return positions;
}

/// Returns the largest distance to which floats may be rounded around a point. Rounding itself and
/// comparing is no way: at -O3, GCC 12 drops pairs of conversions to float and back.
double float_rounding(const Eigen::Vector3d& point) {
    constexpr double half_ulp = 0.5 * std::numeric_limits<float>::epsilon();
    return (1 + 1e-6) * half_ulp * point.norm() + 2.0 * std::numeric_limits<float>::denorm_min();
}

/// Returns `from` moved by `movement`, or only by as much of it as does not exceed the bound, after
/// rounding. Sets `stopped` if it does.
Eigen::Vector3d bounded(const Eigen::Vector3d& from, const Eigen::Vector3d& movement, double bound,
                        bool& stopped) {
    Eigen::Vector3d to = from + movement;
    // Rounding may exceed the bound a few times.
    double shrink = std::numeric_limits<double>::epsilon();
    for (double scale = bound / movement.norm(); (to - from).norm() > bound; shrink *= 2) {
        stopped = true;
        to = from + scale * movement;
        scale *= 1 - std::min(shrink, 1.0);
    }
    return to;
}

/// Returns the mesh's positions after its surface has moved to `to`. Vertices that do not move keep
/// their bits.
std::vector<Eigen::Vector3d> moved_positions(const TriangleMesh& mesh, const SurfaceOfMesh& from,
                                             const Positions& to, double bound,
                                             NoiseReport& report) {
    std::vector<Eigen::Vector3d> after = mesh.positions;
    std::vector<std::uint8_t> is_stopped(to.size(), 0);  // copies of a vertex count once
    for (std::size_t i = 0; i < after.size(); ++i) {
        const std::int32_t vertex = from.vertices[i];
        if (vertex < 0 || from.surface.is_fixed(vertex)) continue;
        const Eigen::Vector3d movement = from.edge * (to[vertex] - from.surface.positions[vertex]);
        after[i] += movement;
        if (bound == 0) continue;
        const double margin = mesh.single_precision ? float_rounding(after[i]) : 0;
        bool stopped = false;
        after[i] = bounded(mesh.positions[i], movement, std::max(0.0, bound - margin), stopped);
        if (stopped) is_stopped[vertex] = 1;
    }
    report.bounded_vertices = std::count(is_stopped.begin(), is_stopped.end(), 1);
    return after;
}

/// Returns how far each vertex of the surface has moved, in mesh units. Its copies move alike.
Positions movements(const TriangleMesh& mesh, const std::vector<Eigen::Vector3d>& after,
                    const SurfaceOfMesh& from) {
    Positions moved(from.surface.positions.size(), Eigen::Vector3d::Zero());
    for (std::size_t i = 0; i < after.size(); ++i) {
        const std::int32_t vertex = from.vertices[i];
        if (vertex >= 0) moved[vertex] = after[i] - mesh.positions[i];
    }
    return moved;
}

void report_losses(const TriangleMesh& mesh, const SurfaceOfMesh& from, const Positions& moved,
                   NoiseReport& report) {
    double farthest = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        if (from.vertices[i] >= 0)
            farthest = std::max(farthest, mesh.positions[i].lpNorm<Eigen::Infinity>());
    }
    const double rounding = std::numeric_limits<double>::epsilon() * farthest / from.edge;
    Positions to = from.surface.positions;
    for (std::size_t i = 0; i < to.size(); ++i) to[i] += moved[i] / from.edge;
    const Losses losses = losses_of(from.surface, to, rounding);
    report.shrunken_parts = losses.parts;
    report.lost_area = losses.area;
    report.lost_volume = losses.volume;
}

}  // namespace

NoiseReport remove_noise(TriangleMesh& mesh, const Inputs& inputs,
                         const NoiseParameters& parameters, const Progress& progress) {
    validate(parameters);
    FilterRun run(parameters.threads, progress);
    enter_phase(0, "Checking the mesh");
    validate(mesh, inputs);
    check_memory(mesh);
    NoiseReport report;
    enter_phase(0.01, "Finding the edges");
    std::optional<Domain> domain(std::in_place, mesh, inputs,
                                 parameters.boundary == NoiseBoundary::Locked
                                     ? BoundaryCondition::Locked
                                     : BoundaryCondition::Free);
    const MovingPart part = moving_part_of(*domain);
    bounding_box(domain->surface());  // throws if the size is none to compute with
    report_domain(*domain, report);
    SurfaceOfMesh from = surface_of(*domain);
    domain.reset();
    report.stop = NoiseStop::NothingMoves;
    const std::vector<float>& fidelity = from.surface.fidelity;
    const bool moves = std::any_of(fidelity.begin(), fidelity.end(), [](float f) { return f > 0; });
    const Positions to =
        moves ? without_noise(from.surface, from.edge, parameters, report) : from.surface.positions;
    enter_phase(0.95, "Moving the vertices");
    std::vector<Eigen::Vector3d> after =
        moved_positions(mesh, from, to, parameters.largest_movement, report);
    report_change(mesh, after, part, parameters.quality, report);
    if (report.largest_displacement > 0)
        report_losses(mesh, from, movements(mesh, after, from), report);
    run.finish(mesh, std::move(after), report);
    return report;
}

}  // namespace tracked_mcf
