// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/tool/documents/file_document.h"

namespace tracked_mcf {

/// A mesh file in text. write() copies the text and replaces only the coordinates that have
/// changed.
class TextDocument : public FileDocument {
public:
    std::vector<Color> vertex_colors() const override;
    void write(std::ostream& out, const Points& positions) const override;

protected:
    using PointWords = std::array<std::string_view, 3>;

    explicit TextDocument(std::string content) : content_(std::move(content)) {}

    /// Appends the point of these words of the content to `points`: to positions_ or to normals_.
    /// The words must follow those of the last call.
    void read_point(const PointWords& words, Points& points);

    /// Gives the last vertex a colour; others are white.
    void set_color(const Color& color);
    bool has_colors() const { return !colors_.empty(); }

    std::string content_;
    Points normals_;
    std::vector<std::int32_t> normal_of_corner_;  ///< or -1; may be empty without normals

private:
    struct Point {
        PointWords words;
        std::int32_t index;  ///< among the positions or the normals
        bool is_normal;
    };

    std::vector<Point> points_;  ///< in the order of the content
    std::vector<Color> colors_;
};

}  // namespace tracked_mcf
