// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/stepping/mean_curvature.h"

#include <cstdint>
#include <limits>

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
/// that have one by then: theirs scatter. In a part without a vertex inside, they keep their own.
void continue_to_rim(const Stars& stars, std::vector<double>& values) {
    if (!stars.has_rim()) return;
    constexpr std::int32_t never = std::numeric_limits<std::int32_t>::max();
    std::vector<std::int32_t> rounds(values.size());  // in which a vertex has its value
    std::vector<std::int32_t> front, next;
    for (std::int32_t vertex = 0; vertex < stars.count(); ++vertex)
        rounds[vertex] = stars.on_rim[vertex] != 0 ? never : 0;
    const auto for_each_neighbour = [&](std::int32_t vertex, const auto& visit) {
        for (auto i = stars.neighbour_begin[vertex]; i < stars.neighbour_begin[vertex + 1]; ++i)
            visit(stars.neighbours[i]);
    };
    const auto reach_neighbours = [&](std::int32_t vertex, std::int32_t round) {
        for_each_neighbour(vertex, [&](std::int32_t neighbour) {
            if (rounds[neighbour] != never) return;
            rounds[neighbour] = round;
            next.push_back(neighbour);
        });
    };
    for (std::int32_t vertex = 0; vertex < stars.count(); ++vertex) {
        if (rounds[vertex] == 0) reach_neighbours(vertex, 1);
    }
    Pacer pacer;
    for (std::int32_t round = 1; !next.empty(); ++round) {
        front.swap(next);
        next.clear();
        for (const std::int32_t vertex : front) {
            double sum = 0;
            int count = 0;
            for_each_neighbour(vertex, [&](std::int32_t neighbour) {
                if (rounds[neighbour] >= round) return;
                sum += values[neighbour];
                ++count;
            });
            values[vertex] = sum / count;
            reach_neighbours(vertex, round + 1);
            pacer.did(1);
        }
    }
}

}  // namespace

std::vector<double> mean_curvatures_of(const Surface& surface, const Positions& positions) {
    const Stars& stars = surface.stars;
    // Held vertices have a curvature, too.
    const std::vector<std::uint8_t> nothing_held(surface.held.size(), 0);
    MeshSolver solver(stars, nothing_held, surface.parts);
    const TriangleElements elements = elements_in_own_metric(stars, positions, {});
    solver.take(elements, kShortStep);
    Field right_side;
    solver.system().multiply_stiffness(positions, 1 / kShortStep, right_side);
    std::vector<double> values(positions.size());  // L x = 2 M H n, and the flux through a rim
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        const bool on_rim = stars.has_rim() && stars.on_rim[vertex] != 0;
        Eigen::Vector3d normal = Eigen::Vector3d::Zero();
        Eigen::Vector3d force = right_side.col(vertex).head<3>().cast<double>();
        for_each_corner(stars, vertex, [&](std::uint32_t triangle, std::uint32_t corner) {
            const auto [a, b, c] = corners_of(positions, stars.triangles[triangle]);
            normal += twice_vector_area(a, b, c);
            if (on_rim)
                force -=
                    rim_flux(stars, triangle, corner, elements[triangle], positions).cast<double>();
        });
        values[vertex] =
            force.dot(normal.normalized()) / (2 * double{solver.system().mass(vertex)});
    });
    continue_to_rim(stars, values);
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        const double integral = double{solver.system().mass(vertex)} * values[vertex];
        right_side.col(vertex) << static_cast<float>(integral), 0, 0, 0;
    });
    Positions smoothed;
    solver.solve(right_side, kToleranceOfCurvature, smoothed);
    std::vector<double> curvatures(surface.vertices.size(), 0);
    parallel_for_rows(static_cast<std::int64_t>(curvatures.size()), [&](std::int32_t i) {
        const std::int32_t vertex = surface.vertices[i];
        if (vertex >= 0) curvatures[i] = smoothed[vertex].x() / surface.edge;
    });
    return curvatures;
}

}  // namespace tracked_mcf
