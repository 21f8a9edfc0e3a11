#include "filter_tracked_mcf/core/held_samples.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "filter_tracked_mcf/core/clip.h"
#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

namespace {

/// Gauss's rule of three nodes on [0, 1], exact to degree 5.
struct SegmentNode {
    double at, weight;
};
const std::array<SegmentNode, 3>& segment_rule() {
    static const double offset = 0.5 * std::sqrt(0.6);
    static const std::array<SegmentNode, 3> rule = {
        {{0.5 - offset, 5.0 / 18}, {0.5, 8.0 / 18}, {0.5 + offset, 5.0 / 18}}};
    return rule;
}

/// Adds the samples of a segment, given in local coordinates.
void add_segment(std::int32_t element, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                 const Eigen::Vector3d& normal, std::vector<HeldSample>& out) {
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

std::vector<HeldSample> sample_held_edges(const TrackedElements& elements, const GridMesh& mesh,
                                          const RawVector<FragmentEntry>& fragments,
                                          const std::vector<std::uint8_t>& held_edges) {
    const auto sample_element = [&](std::int32_t element, std::vector<HeldSample>& out) {
        const Cell cell = cell_at(elements.finest().cells[element]);
        const Eigen::Vector3d origin = cell.cast<double>();
        for (std::int64_t i = elements.fragment_begin[element];
             i < elements.fragment_begin[element + 1]; ++i) {
            const FragmentEntry& entry = fragments[i];
            const std::uint64_t held = entry.edges & held_edges[entry.triangle];
            if (held == 0 || entry.split_triangles == 0) continue;
            const auto corners = mesh.corners(entry.triangle);
            const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            const Polygon polygon = clip_to_cell(corners, cell);
            for (int k = 0; k < polygon.size; ++k) {
                if (polygon.edge[k] == Polygon::kNone || ((held >> polygon.edge[k]) & 1) == 0) {
                    continue;
                }
                const int next = k + 1 < polygon.size ? k + 1 : 0;
                add_segment(element, polygon.points[k] - origin, polygon.points[next] - origin,
                            normal, out);
            }
        }
    };
    return parallel_collect<HeldSample>(
        elements.finest().element_count(),
        [&](std::int64_t begin, std::int64_t end, std::vector<HeldSample>& out) {
            for (auto element = static_cast<std::int32_t>(begin); element < end; ++element) {
                if (elements.held[element] != 0) sample_element(element, out);
            }
        });
}

}  // namespace tracked_mcf
