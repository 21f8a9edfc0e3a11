// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/tool/documents/text_document.h"

#include <ostream>

#include "filter_tracked_mcf/tool/documents/text.h"

namespace tracked_mcf {

std::vector<Color> TextDocument::vertex_colors() const {
    std::vector<Color> colors = colors_;
    if (has_colors()) colors.resize(positions_.size(), kWhite);
    return colors;
}

void TextDocument::write(std::ostream& out, const Points& positions) const {
    const Points normals = corner_normals(positions, polygons_, normal_of_corner_, normals_.size());
    std::string_view rest = content_;
    for (const Point& point : points_) {
        const auto i = static_cast<std::size_t>(point.index);
        // A vertex that has not moved keeps its words.
        if (point.is_normal ? normals[i].isZero(0) : positions[i] == positions_[i]) continue;
        const Eigen::Vector3d& moved = point.is_normal ? normals[i] : positions[i];
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::string_view word = point.words[axis];
            const auto before = static_cast<std::size_t>(word.data() - rest.data());
            out << rest.substr(0, before) << format_number(moved[static_cast<int>(axis)]);
            rest.remove_prefix(before + word.size());
        }
    }
    out << rest;
}

void TextDocument::read_point(const PointWords& words, Points& points) {
    points_.push_back({words, static_cast<std::int32_t>(points.size()), &points == &normals_});
    points.emplace_back(parse_number(words[0]), parse_number(words[1]), parse_number(words[2]));
}

void TextDocument::set_color(const Color& color) {
    colors_.resize(positions_.size(), kWhite);
    colors_.back() = color;
}

}  // namespace tracked_mcf
