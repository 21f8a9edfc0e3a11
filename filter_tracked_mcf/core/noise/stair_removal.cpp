// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/stair_removal.h"

#include <algorithm>
#include <cmath>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/noise/label_smoothing.h"
#include "filter_tracked_mcf/core/noise/turns.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"

namespace tracked_mcf {

namespace {

/// A size of the noise means stairs if it is between these times their height.
constexpr double kLeastSize = 0.5, kMostSize = 2;

/// Returns how many cells a part of labels has inside, or NaN if they are open.
double cells_inside(const Labels& labels, const PartRange& part) {
    if (labels.surface.stars.imbalance != 0) return std::nan("");
    const std::int64_t first = part.first_triangle;
    return std::abs(sum_over_rows(part.end_triangle - first, [&](std::int32_t i) {
        const Triangle& t = labels.surface.stars.triangles[first + i];
        const auto [a, b, c] = corners_of(labels.surface.positions, t);
        return a.dot(b.cross(c)) / 6;
    }));
}

/// Adds the parts of some labels to a result.
void add(const Labels& labels, bool are_meant, const SmoothLabels& smooth,
         const NoisySurface& surface, const std::vector<std::int32_t>& numbers,
         WithoutStairs& result) {
    for (std::size_t part = 0; part < labels.ranges.size(); ++part) {
        const PartRange& range = labels.ranges[part];
        const bool is_certain = smooth.are_certain[part] != 0;
        const bool is_smoothed = is_certain || (are_meant && !labels.lattice.is_soft);
        // A smooth field has none, and without planes at the distance of a cell there are none to
        // name.
        if (!is_smoothed && (labels.lattice.is_soft || labels.has_stairs == std::array<bool, 3>{}))
            continue;
        if (result.height == 0 || (is_smoothed && !result.has(PartKind::Smoothed))) {
            result.cell = smooth.cells * labels.lattice.cell.colwise().norm();
            result.height = smooth.cells * labels.height();
        }
        result.kinds[numbers[labels.vertices[range.first_vertex]]] =
            is_smoothed ? PartKind::Smoothed : PartKind::Kept;
        if (!is_smoothed) continue;
        result.cells += cells_inside(labels, range) / (smooth.cells * smooth.cells * smooth.cells);
        for (std::int32_t i = range.first_vertex; i < range.end_vertex; ++i) {
            const std::int32_t vertex = labels.vertices[i];
            if (!surface.is_held(vertex)) result.positions[vertex] = smooth.positions[i];
        }
    }
}

}  // namespace

bool WithoutStairs::has(PartKind kind) const {
    return std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
}

WithoutStairs remove_stairs(const NoisySurface& surface, const std::vector<std::int32_t>& numbers,
                            double edge, const NoiseParameters& parameters) {
    const std::vector<PartRange> parts = part_ranges(surface.stars, numbers);
    WithoutStairs result;
    result.kinds.assign(parts.size(), PartKind::Other);
    result.positions = surface.positions;
    if (parameters.noise > 0 || parameters.detail_size > 0) return result;
    enter_phase(0, "Looking for voxels and slices");
    const double size = parameters.noise_size / edge;
    for (const Labels& labels : labels_of(surface, parts)) {
        const double height = labels.height();
        const bool is_meant = size >= kLeastSize * height && size <= kMostSize * height;
        if (size > 0 && !is_meant) continue;
        const SmoothLabels smooth =
            without_stairs(labels, crease_of(parameters.crease_angle), parameters.along_normals);
        result.iterations += smooth.iterations;
        add(labels, is_meant, smooth, surface, numbers, result);
    }
    return result;
}

}  // namespace tracked_mcf
