// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/remove_noise.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <utility>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/mesh/filter_run.h"
#include "filter_tracked_mcf/core/noise/denoising.h"
#include "filter_tracked_mcf/core/noise/label_smoothing.h"
#include "filter_tracked_mcf/core/noise/losses.h"
#include "filter_tracked_mcf/core/noise/rim.h"
#include "filter_tracked_mcf/core/noise/stair_removal.h"
#include "filter_tracked_mcf/core/noise/turns.h"
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

/// Removes other noise from the parts of a surface that are no labels, as if they were all of it.
/// Lengths are in edges, and `edge` is their unit.
void denoise_rest(const NoisySurface& surface, const std::vector<std::int32_t>& numbers,
                  const std::vector<PartKind>& kinds, double edge, double rounding,
                  const NoiseParameters& parameters, NoiseReport& report, Positions& positions) {
    std::vector<PartRange> parts = part_ranges(surface.stars, numbers);
    parts.erase(std::remove_if(parts.begin(), parts.end(),
                               [&](const PartRange& part) {
                                   return kinds[numbers[part.first_vertex]] != PartKind::Other;
                               }),
                parts.end());
    SurfaceParts rest = parts_from(surface, parts);
    const double unit = mean_edge_of(rest.surface);
    for (Eigen::Vector3d& position : rest.surface.positions) position /= unit;
    const Positions moved =
        denoised(rest.surface, unit * edge, rounding / unit, parameters, report);
    for (std::size_t i = 0; i < moved.size(); ++i)
        positions[rest.vertices[i]] += unit * (moved[i] - rest.surface.positions[i]);
}

/// Adds what was done to the labels of a surface to what was done to the rest.
void report_stairs(const WithoutStairs& stairs, double edge, NoiseReport& report) {
    report.stairs = edge * stairs.height;
    report.cell_x = edge * stairs.cell[0];
    report.cell_y = edge * stairs.cell[1];
    report.cell_z = edge * stairs.cell[2];
    report.solver_iterations += stairs.iterations;
    if (!stairs.has(PartKind::Other)) {
        report.noise_size = report.stairs;
        report.stop = NoiseStop::NoNoise;
    }
    if (!stairs.has(PartKind::Smoothed)) return;
    report.voxels = std::round(stairs.cells);
    report.smoothing_steps = std::max(report.smoothing_steps, kStepsOfLabels);
    report.kind = NoiseKind::Stairs;
    report.stop = NoiseStop::None;
}

/// Returns the positions of the surface's vertices after they have moved as the parameters ask, and
/// reports how. Sets what became of each part.
Positions without_noise(Surface& surface, double rounding, const NoiseParameters& parameters,
                        std::vector<PartKind>& kinds, NoiseReport& report) {
    const ProgressSpan span(0.3, 0.95);
    std::vector<float> fidelities = fidelities_of(surface);
    NoisySurface noisy{std::move(surface.stars), std::move(surface.positions),
                       std::move(fidelities)};
    WithoutStairs stairs = remove_stairs(noisy, surface.parts, surface.edge, parameters);
    kinds = stairs.kinds;
    Positions positions;
    if (stairs.height == 0) {
        positions = denoised(noisy, surface.edge, rounding, parameters, report);
    } else {
        positions = std::move(stairs.positions);
        if (stairs.has(PartKind::Other)) {
            denoise_rest(noisy, surface.parts, kinds, surface.edge, rounding, parameters, report,
                         positions);
        }
        report_stairs(stairs, surface.edge, report);
    }
    if (parameters.boundary == NoiseBoundary::Smooth) {
        smooth_rim(noisy, crease_of(parameters.crease_angle), confinement(noisy.positions),
                   positions);
    }
    surface.stars = std::move(noisy.stars);
    surface.positions = std::move(noisy.positions);
    return positions;
}

/// Returns the largest distance to which floats may be rounded around a point. Rounding itself and
/// comparing is no way: at -O3, GCC 12 drops pairs of conversions to float and back.
double float_rounding(const Eigen::Vector3d& point) {
    constexpr double half_ulp = 0.5 * std::numeric_limits<float>::epsilon();
    return (1 + 1e-6) * half_ulp * point.norm() + 2.0 * std::numeric_limits<float>::denorm_min();
}

/// Throws if the bound is less than the rounding of every vertex, so that none could move.
void check_largest_movement(const TriangleMesh& mesh, const Surface& surface, double bound) {
    if (bound == 0 || !mesh.single_precision) return;
    double least = std::numeric_limits<double>::infinity();
    for (const std::int32_t vertex : surface.mesh_vertices)
        least = std::min(least, float_rounding(mesh.positions[vertex]));
    if (bound > least) return;
    std::ostringstream problem;
    problem << "is " << bound << ", but the mesh's coordinates are rounded to " << least
            << "; give more, or move the mesh to the origin.";
    throw InvalidParameter("largest_movement", problem.str(), bound);
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
std::vector<Eigen::Vector3d> moved_positions(const TriangleMesh& mesh, const Surface& from,
                                             const Positions& to, double bound,
                                             NoiseReport& report) {
    std::vector<Eigen::Vector3d> after = mesh.positions;
    std::vector<std::uint8_t> is_stopped(to.size(), 0);  // copies of a vertex count once
    for (std::size_t i = 0; i < after.size(); ++i) {
        const std::int32_t vertex = from.vertices[i];
        if (vertex < 0 || from.held[vertex] != 0) continue;
        const Eigen::Vector3d movement = from.edge * (to[vertex] - from.positions[vertex]);
        if (movement.isZero(0)) continue;  // -0 + 0 is another 0
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

/// Returns the error of a coordinate with so many bits, in edges.
double rounding_of(const TriangleMesh& mesh, const Surface& surface, bool single_precision) {
    double farthest = 0;
    for (const std::int32_t vertex : surface.mesh_vertices)
        farthest = std::max(farthest, mesh.positions[vertex].lpNorm<Eigen::Infinity>());
    const double epsilon = single_precision ? double{std::numeric_limits<float>::epsilon()}
                                            : std::numeric_limits<double>::epsilon();
    return epsilon * farthest / surface.edge;
}

/// Returns whether the user has said what the noise is. Then the result is given out whatever it
/// loses.
bool is_told(const NoiseParameters& parameters) {
    return parameters.noise > 0 || parameters.noise_size > 0 || parameters.detail_size > 0;
}

/// Reports what parts lose. Unless the noise is told, parts that lose too much go back to where
/// they were. Labels keep their volume, and lose the area of their stairs.
void check_losses(const TriangleMesh& mesh, const Surface& surface,
                  const std::vector<PartKind>& kinds, bool is_noise_told,
                  std::vector<Eigen::Vector3d>& after, NoiseReport& report) {
    Positions to = surface.positions;
    for (std::size_t i = 0; i < to.size(); ++i) {
        const std::int32_t vertex = surface.mesh_vertices[i];
        to[i] += (after[vertex] - mesh.positions[vertex]) / surface.edge;
    }
    std::vector<PartLoss> losses = losses_of(surface, to, rounding_of(mesh, surface, false));
    for (std::size_t part = 0; part < losses.size(); ++part) {
        PartLoss& loss = losses[part];
        if (kinds[part] == PartKind::Smoothed) loss = {0, 0, 0, 0, loss.turned, 0};
        if (loss.is_too_much()) ++report.shrunken_parts;
        report.turned_triangles += loss.turned;
        report.lost_area = std::max(report.lost_area, loss.area);
        report.lost_volume = std::max(report.lost_volume, loss.volume);
    }
    if (is_noise_told || report.shrunken_parts == 0) return;
    bool moves = false;
    for (std::size_t i = 0; i < after.size(); ++i) {
        const std::int32_t vertex = surface.vertices[i];
        if (vertex < 0) continue;
        if (losses[surface.parts[vertex]].is_too_much()) {
            after[i] = mesh.positions[i];
        } else if (after[i] != mesh.positions[i]) {
            moves = true;
        }
    }
    report.kept_parts = report.shrunken_parts;
    if (moves) return;
    report.stop = NoiseStop::TooMuchLost;
    report.kind = NoiseKind::None;
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
    Surface surface =
        surface_of(mesh, inputs,
                   parameters.boundary == NoiseBoundary::Locked ? BoundaryCondition::Locked
                                                                : BoundaryCondition::Free);
    check_largest_movement(mesh, surface, parameters.largest_movement);
    report_surface(surface, report);
    report.stop = NoiseStop::NothingMoves;
    const double rounding = rounding_of(mesh, surface, mesh.single_precision);
    std::vector<PartKind> kinds(static_cast<std::size_t>(surface.part_count), PartKind::Other);
    const Positions to = report.held_vertices < report.vertices
                             ? without_noise(surface, rounding, parameters, kinds, report)
                             : surface.positions;
    enter_phase(0.95, "Moving the vertices");
    std::vector<Eigen::Vector3d> after =
        moved_positions(mesh, surface, to, parameters.largest_movement, report);
    if (after != mesh.positions)
        check_losses(mesh, surface, kinds, is_told(parameters), after, report);
    report_change(mesh, after, surface, parameters.quality, report);
    run.finish(mesh, std::move(after), report);
    return report;
}

}  // namespace tracked_mcf
