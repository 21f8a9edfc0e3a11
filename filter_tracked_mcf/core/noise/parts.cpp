// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/parts.h"

#include <numeric>
#include <utility>

#include "filter_tracked_mcf/core/mesh/measures.h"

namespace tracked_mcf {

PartRange whole_of(const NoisySurface& surface) {
    return {0, surface.stars.count(), 0, static_cast<std::int64_t>(surface.stars.triangles.size())};
}

std::vector<PartRange> part_ranges(const Stars& stars, const std::vector<std::int32_t>& numbers) {
    std::vector<PartRange> parts;
    for (std::int32_t vertex = 0; vertex < stars.count(); ++vertex) {
        if (vertex == 0 || numbers[vertex] != numbers[vertex - 1])
            parts.push_back({vertex, vertex, 0, 0});
        parts.back().end_vertex = vertex + 1;
    }
    std::int64_t triangle = 0;
    const auto count = static_cast<std::int64_t>(stars.triangles.size());
    for (PartRange& part : parts) {
        part.first_triangle = triangle;
        while (triangle < count && stars.triangles[triangle][0] < part.end_vertex) ++triangle;
        part.end_triangle = triangle;
    }
    return parts;
}

SurfaceParts parts_from(const NoisySurface& surface, const std::vector<PartRange>& parts) {
    SurfaceParts result;
    RawVector<Triangle> triangles;
    for (const PartRange& part : parts) {
        const auto first = static_cast<std::int32_t>(result.vertices.size());
        const std::int32_t shift = first - part.first_vertex;
        const auto first_triangle = static_cast<std::int64_t>(triangles.size());
        result.vertices.resize(result.vertices.size() +
                               static_cast<std::size_t>(part.vertex_count()));
        std::iota(result.vertices.begin() + first, result.vertices.end(), part.first_vertex);
        for (std::int64_t i = part.first_triangle; i < part.end_triangle; ++i) {
            const auto [a, b, c] = surface.stars.triangles[i];
            triangles.push_back({a + shift, b + shift, c + shift});
        }
        result.ranges.push_back({first, part.end_vertex + shift, first_triangle,
                                 static_cast<std::int64_t>(triangles.size())});
    }
    const auto count = static_cast<std::int32_t>(result.vertices.size());
    result.surface.stars = Stars(std::move(triangles), count);
    result.surface.positions.resize(result.vertices.size());
    result.surface.fidelity.resize(result.vertices.size());
    parallel_for_rows(count, [&](std::int32_t i) {
        result.surface.positions[i] = surface.positions[result.vertices[i]];
        result.surface.fidelity[i] = surface.fidelity[result.vertices[i]];
    });
    return result;
}

std::vector<Eigen::Vector3d> some_positions(const NoisySurface& surface, const PartRange& part,
                                            std::int32_t count) {
    const std::int32_t step = part.vertex_count() / count + 1;
    std::vector<Eigen::Vector3d> positions;
    for (std::int32_t i = part.first_vertex; i < part.end_vertex; i += step)
        positions.push_back(surface.positions[i]);
    return positions;
}

double mean_edge_of(const NoisySurface& surface) {
    const auto count = static_cast<std::int64_t>(surface.stars.triangles.size());
    return sum_over_rows(
               count,
               [&](std::int32_t i) {
                   return perimeter(corners_of(surface.positions, surface.stars.triangles[i]));
               }) /
           (3 * static_cast<double>(count));
}

}  // namespace tracked_mcf
