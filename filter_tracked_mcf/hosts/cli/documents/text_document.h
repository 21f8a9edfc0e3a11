// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/hosts/cli/documents/file_document.h"
#include "filter_tracked_mcf/hosts/cli/documents/text.h"

namespace tracked_mcf {

/// A mesh file in text, or in big-endian floats. write() copies the content and replaces only the
/// coordinates that have changed.
class TextDocument : public FileDocument {
public:
    bool writes_floats() const override { return numbers_ != Numbers::Doubles; }
    void write(std::ostream& out, const Points& positions) const override;

protected:
    /// How the content has its numbers. FloatWords are words that mean floats.
    enum class Numbers { Doubles, FloatWords, BigEndianFloats };
    using PointWords = std::array<std::string_view, 3>;

    explicit TextDocument(std::string content) : content_(std::move(content)) {}

    /// Appends the point of these words of the content to `points`: to positions_ or to normals_.
    /// The words must follow those of the last call. An empty word, which follows the others
    /// without a blank, is a zero that is missing.
    void read_point(const PointWords& words, Points& points);

    std::string content_;
    Numbers numbers_ = Numbers::Doubles;
    Points normals_;
    std::vector<std::int32_t> normal_of_corner_;  ///< or -1; may be empty without normals

private:
    struct Point {
        PointWords words;
        std::int32_t index;  ///< among the positions or the normals
        bool is_normal;
    };

    double parse(std::string_view word) const;
    std::string format(double number) const;

    std::vector<Point> points_;  ///< in the order of the content
};

}  // namespace tracked_mcf
