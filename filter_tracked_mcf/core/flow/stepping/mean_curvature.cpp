// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/stepping/mean_curvature.h"

#include <cstdint>

#include "filter_tracked_mcf/core/flow/solver/mesh_solver.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/mesh/triangle_elements.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"

namespace tracked_mcf {

namespace {

/// The length of the step, in squared edges, by which mean curvatures are smoothed. They scatter by
/// 5 % on a sphere of regular triangles otherwise.
constexpr double kShortStep = 2;

/// The tolerance to which they are.
constexpr double kToleranceOfCurvature = 1e-3;

/// Gives the vertices of a rim the mean value of their neighbours inside, or of other neighbours
/// that have one by then. Their own is that of the surface's edge, which has no curvature.
void continue_to_rim(const Stars& stars, std::vector<double>& values) {
    if (stars.on_rim.empty()) return;
    std::vector<std::uint8_t> has_value(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) has_value[i] = stars.on_rim[i] != 0 ? 0 : 1;
    for (bool goes_on = true; goes_on;) {
        goes_on = false;
        const std::vector<std::uint8_t> had_value = has_value;
        for (std::int32_t vertex = 0; vertex < stars.count(); ++vertex) {
            if (had_value[vertex] != 0) continue;
            double sum = 0;
            int count = 0;
            for (auto i = stars.neighbour_begin[vertex]; i < stars.neighbour_begin[vertex + 1];
                 ++i) {
                if (had_value[stars.neighbours[i]] == 0) continue;
                sum += values[stars.neighbours[i]];
                ++count;
            }
            values[vertex] = count > 0 ? sum / count : 0;
            has_value[vertex] = count > 0 ? 1 : 0;
            goes_on = goes_on || count > 0;
        }
        poll_progress();
    }
}

}  // namespace

std::vector<double> mean_curvatures_of(const FlowSurface& surface) {
    const Stars& stars = surface.stars;
    const std::vector<Eigen::Vector3d>& positions = surface.positions;
    // Vertices that stay have a curvature, too.
    const std::vector<std::uint8_t> fixed(surface.fixed.size(), 0);
    MeshSolver solver(stars, fixed, surface.components);
    solver.take(elements_in_own_metric(stars, positions, {}), kShortStep);
    Field right_side;
    solver.system().multiply_stiffness(positions, 1 / kShortStep, right_side);
    std::vector<double> values(positions.size());  // L x = 2 M H n
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        Eigen::Vector3d normal = Eigen::Vector3d::Zero();
        for_each_corner(stars, vertex, [&](std::uint32_t triangle, std::uint32_t /*corner*/) {
            const auto [a, b, c] = corners_of(positions, stars.triangles[triangle]);
            normal += twice_vector_area(a, b, c);
        });
        const Eigen::Vector3d force = right_side.col(vertex).head<3>().cast<double>();
        values[vertex] =
            force.dot(normal.normalized()) / (2 * double{solver.system().mass(vertex)});
    });
    continue_to_rim(stars, values);
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        const double integral = double{solver.system().mass(vertex)} * values[vertex];
        right_side.col(vertex) << static_cast<float>(integral), 0, 0, 0;
    });
    std::vector<Eigen::Vector3d> smoothed;
    solver.solve(right_side, kToleranceOfCurvature, smoothed);
    std::vector<double> curvatures(surface.vertices.size(), 0);
    parallel_for_rows(static_cast<std::int64_t>(curvatures.size()), [&](std::int32_t i) {
        const std::int32_t vertex = surface.vertices[i];
        if (vertex >= 0) curvatures[i] = smoothed[vertex].x() / surface.edge;
    });
    return curvatures;
}

}  // namespace tracked_mcf
