// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/elements/curve_samples.h"

#include <array>
#include <cmath>

#include "filter_tracked_mcf/core/cells/clip.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// A node of Gauss's rule of three points on [0, 1], exact to degree 5.
struct SegmentNode {
    double at, weight;
};
const std::array<SegmentNode, 3>& segment_rule() {
    static const double offset = 0.5 * std::sqrt(0.6);
    static const std::array<SegmentNode, 3> rule = {
        {{0.5 - offset, 5.0 / 18}, {0.5, 8.0 / 18}, {0.5 + offset, 5.0 / 18}}};
    return rule;
}

/// Appends the samples of a segment, given in local coordinates.
void add_segment(std::int32_t element, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                 const Eigen::Vector3d& normal, std::vector<CurveSample>& out) {
    const Eigen::Vector3d along = to - from;
    const double length = along.norm();
    if (length == 0) return;
    const Eigen::Vector3f conormal = along.cross(normal).normalized().cast<float>();
    for (const SegmentNode& node : segment_rule()) {
        const Eigen::Vector3f local = (from + node.at * along).cast<float>();
        out.push_back({element, local, conormal, static_cast<float>(node.weight * length)});
    }
}

}  // namespace

std::vector<CurveSample> sample_constrained_edges(
    const TrackedElements& elements, const GridMesh& mesh,
    const RawVector<FragmentEntry>& fragments, const std::vector<std::uint8_t>& constrained_edges) {
    const auto sample_element = [&](std::int32_t element, std::vector<CurveSample>& out) {
        const Cell cell = cell_at(elements.finest().cells[element]);
        const Eigen::Vector3d origin = cell.cast<double>();
        for (std::int64_t i = elements.fragment_begin[element];
             i < elements.fragment_begin[element + 1]; ++i) {
            const FragmentEntry& entry = fragments[i];
            const std::uint64_t constrained = entry.edges & constrained_edges[entry.triangle];
            if (constrained == 0 || entry.split_triangles == 0) continue;
            const auto corners = mesh.corners(entry.triangle);
            const Eigen::Vector3d normal = twice_vector_area(corners[0], corners[1], corners[2]);
            const Polygon polygon = clip_to_cell(corners, cell);
            for (int k = 0; k < polygon.size; ++k) {
                const std::int8_t edge = polygon.edge[k];
                if (edge == Polygon::kNone || !has_bit(constrained, edge)) continue;
                add_segment(element, polygon.points[k] - origin,
                            polygon.points[polygon.next(k)] - origin, normal, out);
            }
        }
    };
    return parallel_collect<CurveSample>(
        elements.finest().element_count(),
        [&](std::int64_t begin, std::int64_t end, std::vector<CurveSample>& out) {
            for (auto element = static_cast<std::int32_t>(begin); element < end; ++element) {
                if (elements.meets_constrained_edge[element] != 0) sample_element(element, out);
            }
        });
}

}  // namespace tracked_mcf
