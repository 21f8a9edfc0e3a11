// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/confinement.h"

#include <algorithm>

#include "filter_tracked_mcf/core/cells/grid.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

Confinement::Confinement(const TrackedElements& elements, double detail_size)
    : elements_(elements) {
    initial_boxes_ = boxes(Coefficients::Zero(elements.finest().unknown_count(), 3));
    Eigen::AlignedBox3d all;
    for (const Eigen::AlignedBox3d& box : initial_boxes_) all.extend(box);
    const double diagonal = all.diagonal().norm();
    margin_ = kMarginInDiagonals * diagonal + kMarginInCells +
              kMarginInDetail * std::min(detail_size, diagonal);
    add_margin(initial_boxes_);
}

void Confinement::add_margin(std::vector<Eigen::AlignedBox3d>& boxes) const {
    for (Eigen::AlignedBox3d& box : boxes) {
        box = {box.min().array() - margin_, box.max().array() + margin_};
    }
}

std::vector<Eigen::AlignedBox3d> Confinement::boxes(const Coefficients& displacement) const {
    std::vector<Eigen::AlignedBox3d> boxes(static_cast<std::size_t>(elements_.components.count));
    for (std::size_t vertex = 0; vertex < elements_.vertices.size(); ++vertex) {
        const std::int32_t element = elements_.vertices[vertex].element;
        if (element == VertexLocation::kNoElement) continue;
        boxes[elements_.components.of_element[element]].extend(
            position(displacement, static_cast<std::int32_t>(vertex)));
    }
    add_margin(boxes);
    return boxes;
}

bool Confinement::holds(const Coefficients& displacement,
                        const std::vector<Eigen::AlignedBox3d>& boxes) const {
    // The displacement of a vertex is a mean of coefficients.
    const double largest = displacement.cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
    if (boxes.empty() && largest <= margin_) return true;
    const std::vector<Eigen::AlignedBox3d>& allowed = boxes.empty() ? initial_boxes_ : boxes;
    const auto count = static_cast<std::int64_t>(elements_.vertices.size());
    return 0 == parallel_count(count, [&](std::int64_t vertex) {
               const VertexLocation& location = elements_.vertices[vertex];
               if (location.element == VertexLocation::kNoElement) return false;
               if (elements_.vertex_constrained[vertex] != 0) return false;
               return !allowed[elements_.components.of_element[location.element]].contains(
                   position(displacement, static_cast<std::int32_t>(vertex)));
           });
}

Eigen::Vector3d Confinement::position(const Coefficients& displacement, std::int32_t vertex) const {
    const VertexLocation& location = elements_.vertices[vertex];
    const Cell cell = cell_at(elements_.finest().cells[location.element]);
    return cell.cast<double>() + location.local +
           evaluate_vertex(elements_, displacement, location);
}

}  // namespace tracked_mcf
