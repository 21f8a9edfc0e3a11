// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>
#include <algorithm>
#include <ostream>

#include "filter_tracked_mcf/hosts/cli/documents/binary.h"
#include "filter_tracked_mcf/hosts/cli/documents/text_document.h"
#include "filter_tracked_mcf/hosts/cli/file_error.h"

namespace tracked_mcf {

namespace {

/// A binary file has a header, the number of triangles in 4 bytes, and for each triangle 12 floats
/// (the normal and three vertices) and 2 bytes, which some programs use for a colour.
constexpr std::size_t kHeaderSize = 80, kBegin = 84, kTriangleSize = 50;

using Floats = Eigen::Vector3f;

/// Triangles with three vertices of their own each. Coordinates are floats, also in text.
class StlDocument : public TextDocument {
public:
    explicit StlDocument(std::string content) : TextDocument(std::move(content)) {
        numbers_ = Numbers::FloatWords;
        const std::string problem = problem_of_binary();
        // The size decides first, because some binary files begin with "solid".
        is_binary_ = problem.empty();
        if (is_binary_)
            read_binary();
        else if (is_text())
            read_text();
        else
            throw UnreadableFile(problem);
    }

    std::vector<std::string> extras() const override {
        std::vector<std::string> extras;
        if (has_colors_) extras.emplace_back("colours of triangles");
        if (solid_count_ > 1) extras.emplace_back("solids");
        return extras;
    }

    void write(std::ostream& out, const Points& positions) const override {
        if (!is_binary_) return TextDocument::write(out, positions);
        const Points normals = moved_normals(positions_, positions, precision(), polygons_,
                                             normal_of_corner_, polygons_.size());
        Patch patch(out, content_);
        for (std::size_t i = 0; i < normals.size(); ++i) {
            for (std::size_t k = 0; k < 4; ++k) {
                const Eigen::Vector3d& vector = k == 0 ? normals[i] : positions[3 * i + k - 1];
                if (k == 0 && vector.isZero(0)) continue;
                patch.replace(vector_bytes(i, k), as_bytes(Floats(vector.cast<float>())));
            }
        }
        patch.finish();
    }

private:
    /// Returns whether the beginning has no control characters but blanks and those at the end.
    bool is_text() const {
        const auto end = content_.find_last_not_of(std::string_view("\0\x1A", 2)) + 1;
        return std::none_of(content_.begin(), content_.begin() + std::min<std::ptrdiff_t>(end, 999),
                            [](unsigned char c) { return c < '\t'; });
    }

    /// Says what is wrong, or nothing.
    std::string problem_of_binary() const {
        const std::size_t size = content_.size();
        if (size < kBegin) return "it is neither a binary nor an ASCII STL file";
        const auto count = number_from<std::uint32_t>(&content_[kHeaderSize]);
        const std::size_t announced = kBegin + kTriangleSize * count;
        // Some programs append bytes, but whole triangles too many mean that the count is wrong.
        if (size == announced || (size > announced && (size - announced) % kTriangleSize != 0)) {
            return {};
        }
        return "it announces " + std::to_string(count) + " triangles, which take " +
               std::to_string(announced) + " bytes, but it has " + std::to_string(size);
    }

    void read_binary() {
        const auto count = number_from<std::uint32_t>(&content_[kHeaderSize]);
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t k = 1; k < 4; ++k) {
                const auto corner = number_from<std::array<float, 3>>(vector_bytes(i, k).data());
                add_corner(static_cast<std::int32_t>(i));
                positions_.emplace_back(corner[0], corner[1], corner[2]);
            }
            polygons_.close();
            const auto color = number_from<std::uint16_t>(vector_bytes(i, 4).data());
            has_colors_ = has_colors_ || color != 0;
        }
    }

    /// Returns the bytes of a binary triangle's normal, k = 0, or corner, and what follows.
    std::string_view vector_bytes(std::size_t i, std::size_t k) const {
        const std::size_t begin = kBegin + kTriangleSize * i + sizeof(Floats) * k;
        return std::string_view(content_).substr(begin, sizeof(Floats));
    }

    void read_text() {
        TextReader reader(content_);
        std::int32_t normal = -1;
        std::string first;
        while (reader.words_left() > 0 || reader.find_line()) {
            const std::string word = lower_case(reader.word());
            if (first.empty()) first = word;
            if (first != "solid" && first != "facet") {
                throw UnreadableFile("it is a text that does not begin with 'solid'");
            }
            if (word == "normal" && reader.words_left() >= 3) {
                normal = static_cast<std::int32_t>(normals_.size());
                read_point({reader.word(), reader.word(), reader.word()}, normals_);
            } else if (word == "vertex") {
                add_corner(normal);
                read_point({reader.word(), reader.word(), reader.word()}, positions_);
            } else if (word == "endloop") {
                polygons_.close();
                normal = -1;
                if (polygons_.corner_count(polygons_.size() - 1) != 3) {
                    reader.fail("a facet does not have 3 vertices");
                }
            } else if (word == "solid" || word == "endsolid") {
                solid_count_ += word == "solid" ? 1 : 0;
                // A name may be any words. It ends with its line, or before a facet.
                while (reader.words_left() > 0 && lower_case(reader.next_word()) != "facet") {
                    reader.word();
                }
            }
        }
        if (polygons_.corners.size() > polygons_.first.back()) {
            throw UnreadableFile("it ends within a facet; it is truncated");
        }
    }

    void add_corner(std::int32_t normal) {
        polygons_.corners.push_back(static_cast<std::int32_t>(polygons_.corners.size()));
        normal_of_corner_.push_back(normal);
    }

    bool is_binary_ = false, has_colors_ = false;
    std::size_t solid_count_ = 0;  ///< in text
};

}  // namespace

std::unique_ptr<FileDocument> parse_stl(std::string&& content) {
    return std::make_unique<StlDocument>(std::move(content));
}

void convert_to_stl(std::ostream& out, const FileDocument& source, const Points& positions) {
    const std::vector<Triangle> triangles = fans(source.polygons());
    std::string header = "binary STL by tracked_mcf";
    header.resize(kHeaderSize, ' ');
    out << header << as_bytes(static_cast<std::uint32_t>(triangles.size()));
    for (const Triangle& triangle : triangles) {
        const auto corner = [&](std::size_t k) -> const Eigen::Vector3d& {
            return positions[static_cast<std::size_t>(triangle[k])];
        };
        const Eigen::Vector3d area = (corner(1) - corner(0)).cross(corner(2) - corner(0));
        out << as_bytes(Floats(area.stableNormalized().cast<float>()));
        for (std::size_t k = 0; k < 3; ++k) out << as_bytes(Floats(corner(k).cast<float>()));
        out << as_bytes(std::uint16_t{0});
    }
}

}  // namespace tracked_mcf
