// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/documents/text_document.h"

#include <cmath>
#include <ostream>

#include "filter_tracked_mcf/hosts/cli/documents/binary.h"

namespace tracked_mcf {

void TextDocument::write(std::ostream& out, const Points& positions) const {
    const Points normals = moved_normals(positions_, positions, precision(), polygons_,
                                         normal_of_corner_, normals_.size());
    Patch patch(out, content_);
    for (const Point& point : points_) {
        const auto i = static_cast<std::size_t>(point.index);
        if (point.is_normal && normals[i].isZero(0)) continue;
        const Eigen::Vector3d& before = point.is_normal ? normals_[i] : positions_[i];
        const Eigen::Vector3d& after = point.is_normal ? normals[i] : positions[i];
        for (int axis = 0; axis < 3; ++axis) {
            const std::string_view word = point.words[static_cast<std::size_t>(axis)];
            if (before[axis] == after[axis] || std::isnan(after[axis])) continue;
            patch.replace(word, (word.empty() ? " " : "") + format(after[axis]));
        }
    }
    patch.finish();
}

void TextDocument::read_point(const PointWords& words, Points& points) {
    points_.push_back({words, static_cast<std::int32_t>(points.size()), &points == &normals_});
    Eigen::Vector3d& point = points.emplace_back(Eigen::Vector3d::Zero());
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!words[axis].empty()) point[static_cast<int>(axis)] = parse(words[axis]);
    }
}

double TextDocument::parse(std::string_view word) const {
    if (numbers_ == Numbers::BigEndianFloats) return number_from<float>(reversed(word).data());
    const double number = parse_number(word);
    return numbers_ == Numbers::FloatWords ? static_cast<float>(number) : number;
}

std::string TextDocument::format(double number) const {
    if (numbers_ == Numbers::Doubles) return format_number(number);
    const auto rounded = static_cast<float>(number);
    return numbers_ == Numbers::FloatWords ? format_number(rounded) : reversed(as_bytes(rounded));
}

}  // namespace tracked_mcf
