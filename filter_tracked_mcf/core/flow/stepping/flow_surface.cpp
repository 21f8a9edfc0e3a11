// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/stepping/flow_surface.h"

#include <algorithm>
#include <utility>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/flow/cells/fragments.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/mesh/mesh_topology.h"
#include "filter_tracked_mcf/core/parallel/disjoint_sets.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/parallel/sorting.h"

namespace tracked_mcf {

namespace {

/// Vertices are put in the order of a grid of so many cells a side.
constexpr int kDepthOfOrder = 20;

/// Returns the mesh's vertices that the triangles use, in the order of space.
RawVector<KeyValue> used_vertices(const RawVector<Triangle>& triangles,
                                  const std::vector<Eigen::Vector3d>& positions, const Grid& grid) {
    std::vector<std::uint8_t> used(positions.size(), 0);
    for (const Triangle& t : triangles) {
        if (!has_three_vertices(t)) continue;
        for (const std::int32_t vertex : t) used[vertex] = 1;
    }
    auto vertices = parallel_collect_if<KeyValue, RawVector<KeyValue>>(
        static_cast<std::int64_t>(used.size()), [&](std::int64_t i) { return used[i] != 0; },
        [&](std::int64_t i) {
            const Cell cell =
                grid.to_grid(positions[i]).array().floor().cast<std::int32_t>().matrix();
            return KeyValue{morton_code(cell), static_cast<std::uint64_t>(i)};
        });
    sort_by_key(vertices);
    return vertices;
}

void find_components(FlowSurface& surface) {
    const std::int32_t count = surface.stars.count();
    ConcurrentSets sets(count);
    parallel_for_items(surface.stars.triangles, [&](const Triangle& t) {
        sets.unite(t[0], t[1]);
        sets.unite(t[1], t[2]);
    });
    surface.components.resize(static_cast<std::size_t>(count));
    for (std::int32_t vertex = 0; vertex < count; ++vertex) {
        const std::int32_t first = sets.find(vertex);
        surface.components[vertex] =
            first == vertex ? surface.component_count++ : surface.components[first];
    }
}

}  // namespace

Grid cube_around(const Eigen::AlignedBox3d& box) {
    constexpr double relative_side = 1.1;
    const double side = relative_side * box.sizes().maxCoeff();
    const Eigen::Vector3d margin = side * Eigen::Vector3d(0.0312, 0.0437, 0.0359);
    return {box.center().array() - box.sizes().maxCoeff() / 2 - margin.array(), side, 0};
}

FlowSurface flow_surface_of(const Domain& domain, const std::vector<double>& densities) {
    const TriangleMesh& mesh = domain.mesh();
    const RawVector<Triangle>& triangles = domain.topology().triangles;
    const Eigen::AlignedBox3d box = bounding_box(domain.surface());
    const Grid grid = with_depth(cube_around(box), kDepthOfOrder);
    const RawVector<KeyValue> used = used_vertices(triangles, mesh.positions, grid);
    FlowSurface surface{{{}, 0}, {}, {}, {}, {}, 0, 0, 1, {}};
    surface.edge = mean_edge_length(domain.surface());
    surface.vertices.assign(mesh.positions.size(), -1);
    const auto count = static_cast<std::int32_t>(used.size());
    const Eigen::Vector3d middle = box.center();
    surface.positions.resize(used.size());
    surface.fixed.resize(used.size());
    parallel_for_rows(count, [&](std::int32_t i) {
        const auto vertex = static_cast<std::int32_t>(used[i].value);
        surface.vertices[vertex] = i;
        surface.positions[i] = (mesh.positions[vertex] - middle) / surface.edge;
        surface.fixed[i] = domain.constrained_vertices()[vertex];
    });
    RawVector<Triangle> renumbered;
    renumbered.reserve(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Triangle& t = triangles[i];
        if (!has_three_vertices(t)) continue;
        renumbered.push_back(
            {surface.vertices[t[0]], surface.vertices[t[1]], surface.vertices[t[2]]});
        if (!densities.empty()) surface.densities.push_back(static_cast<float>(densities[i]));
    }
    surface.constrained_count = std::count_if(surface.fixed.begin(), surface.fixed.end(),
                                              [](std::uint8_t flag) { return flag != 0; });
    surface.stars = Stars(std::move(renumbered), count);
    find_components(surface);
    parallel_for_rows(static_cast<std::int64_t>(mesh.positions.size()), [&](std::int32_t i) {
        const std::int32_t welded = domain.topology().welded[i];
        if (welded != i) surface.vertices[i] = surface.vertices[welded];
    });
    return surface;
}

}  // namespace tracked_mcf
