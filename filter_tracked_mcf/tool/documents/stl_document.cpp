// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <ostream>

#include "filter_tracked_mcf/tool/documents/binary.h"
#include "filter_tracked_mcf/tool/documents/file_document.h"
#include "filter_tracked_mcf/tool/documents/text.h"
#include "filter_tracked_mcf/tool/file_error.h"

namespace tracked_mcf {

namespace {

/// A binary file has a header, the number of triangles in 4 bytes, and for each triangle 12 floats
/// (the normal and three vertices) and 2 bytes, which some programs use for a colour.
constexpr std::size_t kHeaderSize = 80, kCountSize = 4, kFloatsSize = 48, kTriangleSize = 50;

void write_floats(std::ostream& out, const Eigen::Vector3d& v) {
    out << as_bytes(Eigen::Vector3f(v.cast<float>()));
}

/// Writes a binary file. `attributes` has the last two bytes of each triangle; empty is all zero.
void write_binary(std::ostream& out, std::string header, const Points& positions,
                  const std::vector<Triangle>& triangles,
                  const std::vector<std::uint16_t>& attributes) {
    header.resize(kHeaderSize, ' ');
    out << header;
    out << as_bytes(static_cast<std::uint32_t>(triangles.size()));
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        std::array<Eigen::Vector3d, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = positions[static_cast<std::size_t>(triangles[i][k])];
        }
        const Eigen::Vector3d area = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        write_floats(out, area.stableNormalized());
        for (const Eigen::Vector3d& corner : corners) write_floats(out, corner);
        out << as_bytes(attributes.empty() ? std::uint16_t{0} : attributes[i]);
    }
}

/// Triangles with three vertices of their own each. Coordinates are floats, as in binary files.
class StlDocument : public FileDocument {
public:
    explicit StlDocument(std::string_view content) {
        const std::string problem = problem_of_binary(content);
        const bool is_ascii =
            content.substr(0, 5) == "solid" && content.find('\0') == std::string_view::npos;
        // The size decides first, because some binary files begin with "solid".
        if (problem.empty())
            read_binary(content);
        else if (is_ascii)
            read_ascii(content);
        else
            throw UnreadableFile(problem);
    }

    std::vector<std::string> extras() const override {
        for (const std::uint16_t attribute : attributes_) {
            if (attribute != 0) return {"colours of triangles"};
        }
        return {};
    }

    /// Writes a binary file whatever the file was.
    void write(std::ostream& out, const Points& positions) const override {
        write_binary(out, header_, positions, triangles(), attributes_);
    }

private:
    /// Says what is wrong, or nothing.
    static std::string problem_of_binary(std::string_view content) {
        if (content.size() < kHeaderSize + kCountSize) {
            return "it is neither a binary nor an ASCII STL file";
        }
        const auto count = number_from<std::uint32_t>(content.data() + kHeaderSize);
        if (count == 0) return "it has no triangles";
        const std::size_t announced = kHeaderSize + kCountSize + kTriangleSize * count;
        if (content.size() == announced) return {};
        return "it announces " + std::to_string(count) + " triangles, which take " +
               std::to_string(announced) + " bytes, but it has " + std::to_string(content.size());
    }

    void read_binary(std::string_view content) {
        header_ = content.substr(0, kHeaderSize);
        content.remove_prefix(kHeaderSize + kCountSize);
        for (; !content.empty(); content.remove_prefix(kTriangleSize)) {
            const auto number = [&](std::size_t i) {
                return double{number_from<float>(content.data() + i * sizeof(float))};
            };
            for (std::size_t i = 3; i < 12; i += 3) {
                add_corner({number(i), number(i + 1), number(i + 2)});
            }
            polygons_.close();
            attributes_.push_back(number_from<std::uint16_t>(content.data() + kFloatsSize));
        }
    }

    void read_ascii(std::string_view content) {
        if (content.find('\n') == std::string_view::npos) {
            throw UnreadableFile("it is a single line");
        }
        if (content.find("endsolid") == std::string_view::npos) {
            throw UnreadableFile("it ends before 'endsolid'; it is truncated");
        }
        for (WordReader words(content); words.has_more();) {
            const std::string_view word = words.word();
            if (word == "vertex") {
                Eigen::Vector3d corner;
                for (int axis = 0; axis < 3; ++axis) {
                    corner[axis] = static_cast<float>(parse_number(words.word()));
                }
                add_corner(corner);
            } else if (word == "endloop") {
                polygons_.close();
                if (polygons_.corner_count(polygons_.size() - 1) != 3) {
                    words.fail("a facet has not 3 vertices");
                }
            } else if (word == "solid" || word == "endsolid") {
                words.take(words.words_left());  // the name may be any words
            }
        }
        if (polygons_.size() == 0) throw UnreadableFile("it has no triangles");
        if (polygons_.corners.size() > polygons_.first.back()) {
            throw UnreadableFile("it ends within a facet; it is truncated");
        }
    }

    void add_corner(const Eigen::Vector3d& position) {
        polygons_.corners.push_back(static_cast<std::int32_t>(positions_.size()));
        positions_.push_back(position);
    }

    std::string header_;  ///< of a binary file
    std::vector<std::uint16_t> attributes_;
};

}  // namespace

std::unique_ptr<FileDocument> parse_stl(std::string&& content) {
    return std::make_unique<StlDocument>(content);
}

void convert_to_stl(std::ostream& out, const FileDocument& source, const Points& positions) {
    write_binary(out, "binary STL by tracked_mcf", positions, source.triangles(), {});
}

}  // namespace tracked_mcf
