// SPDX-License-Identifier: GPL-3.0-or-later
#include <ostream>

#include "filter_tracked_mcf/tool/documents/binary.h"
#include "filter_tracked_mcf/tool/documents/text_document.h"
#include "filter_tracked_mcf/tool/file_error.h"

namespace tracked_mcf {

namespace {

/// What a vertex has besides coordinates, as the header's keyword says.
struct VertexLayout {
    bool normal = false, color = false, texture = false;

    /// Returns the number of words of a vertex without its colour.
    std::size_t size() const { return 3u + (normal ? 3u : 0u) + (texture ? 2u : 0u); }
};

/// Takes the letters in any order: MeshLab writes CST where the format has STC.
VertexLayout parse_keyword(const TextReader& reader, const std::string& keyword) {
    const std::size_t end = keyword.rfind("off");
    if (end == std::string::npos) {
        reader.fail("an OFF file begins with OFF, COFF, NOFF, STOFF or a combination of these");
    }
    VertexLayout layout;
    for (std::string_view prefix = std::string_view(keyword).substr(0, end); !prefix.empty();) {
        const bool texture = prefix.substr(0, 2) == "st";
        if (texture)
            layout.texture = true;
        else if (prefix.front() == 'c')
            layout.color = true;
        else if (prefix.front() == 'n')
            layout.normal = true;
        else
            reader.fail("only three dimensions can be read");
        prefix.remove_prefix(texture ? 2 : 1);
    }
    return layout;
}

class OffDocument : public TextDocument {
public:
    explicit OffDocument(std::string content)
        : TextDocument(std::move(content)), reader_(content_, TextReader::Syntax::Comments) {
        are_bytes_ = true;
        reader_.advance();
        const std::string keyword = lower_case(reader_.words()[0]);
        if (keyword.find_first_not_of("0123456789") != std::string::npos) {
            reader_.word();
            layout_ = parse_keyword(reader_, keyword);
        }
        if (reader_.words_left() == 1 && lower_case(reader_.words().back()) == "binary")
            read_binary();
        else
            read_text();
        if (layout_.normal) normal_of_corner_ = polygons_.corners;
    }

    std::vector<Triangle> triangles() const override {
        Polygons polygons = polygons_;
        choose_diagonals(positions_, polygons);
        return fans(polygons);
    }

    std::vector<std::string> extras() const override {
        std::vector<std::string> extras;
        if (layout_.normal) extras.emplace_back("normals");
        if (layout_.texture) extras.emplace_back("texture coordinates");
        if (has_face_colors_) extras.emplace_back("colours of faces");
        if (layout_.color && !has_colors()) extras.emplace_back("indices of colours");
        return extras;
    }

private:
    void read_binary() {
        numbers_ = Numbers::BigEndianFloats;
        bytes_ = reader_.rest();
        read_counts();
        integer();
        for (std::size_t i = 0; i < vertex_count_; ++i) read_vertex();
        for (std::size_t i = 0; i < face_count_; ++i) {
            read_face();
            const auto channels = static_cast<std::size_t>(integer());
            has_face_colors_ = has_face_colors_ || channels > 0;
            take_bytes(bytes_, channels, sizeof(float));
        }
    }

    void read_text() {
        read_counts();
        // The number of edges is not used, and some files lack it.
        if (reader_.words_left() > 0 || (reader_.find_line() && reader_.words_left() == 1)) {
            parse_integer(reader_.word());
        }
        if (vertex_count_ + face_count_ == 0) return;
        if (reader_.words_left() == 0) reader_.advance();
        const std::size_t first_size = reader_.words_left(), size = layout_.size();
        own_lines_ = first_size >= size && reader_.count_lines() + 1 >= vertex_count_ + face_count_;
        whole_ = own_lines_ || first_size == size;
        try {
            for (std::size_t i = 0; i < vertex_count_; ++i)
                read_row(i > 0, &OffDocument::read_vertex);
            for (std::size_t i = 0; i < face_count_; ++i) read_row(true, &OffDocument::read_face);
            check_end();
        } catch (const UnreadableFile& error) {
            reader_.fail(error.what() + ("; are there the " + std::to_string(vertex_count_)) +
                         " vertices and " + std::to_string(face_count_) +
                         " faces that the file announces?");
        }
    }

    void read_counts() {
        for (std::size_t* const count : {&vertex_count_, &face_count_}) {
            const std::int64_t number = integer();
            if (number < 0 || number > 2147483647) reader_.fail("a count is out of range");
            *count = static_cast<std::size_t>(number);
        }
    }

    void read_row(bool is_next, void (OffDocument::*read)()) {
        if (is_next && (own_lines_ || reader_.words_left() == 0)) reader_.advance();
        (this->*read)();
    }

    /// A vertex too many or missing must not be taken for a face or make one a vertex.
    void check_end() {
        const bool all_have_triangles = polygons_.size_with_triangles() == polygons_.size();
        const bool has_more = reader_.find_line() || (!own_lines_ && reader_.words_left() > 0);
        if (own_lines_ && all_have_triangles && !has_long_vertex_) return;
        if (has_more || !(own_lines_ || all_have_triangles)) {
            throw UnreadableFile("more numbers follow, or faces have fewer than 3 corners");
        }
    }

    /// Returns the next word, or the next four bytes.
    std::string_view next() {
        if (numbers_ == Numbers::BigEndianFloats) return take_bytes(bytes_, 1, sizeof(float));
        if (whole_ && reader_.words_left() == 0) {
            throw UnreadableFile("the line has too few numbers");
        }
        return reader_.word();
    }

    std::int64_t integer() {
        const std::string_view word = next();
        return numbers_ == Numbers::BigEndianFloats
                   ? number_from<std::int32_t>(reversed(word).data())
                   : parse_integer(word);
    }

    PointWords point() { return {next(), next(), next()}; }

    void read_vertex() {
        read_point(point(), positions_);
        if (layout_.normal) read_point(point(), normals_);
        if (layout_.color) read_vertex_color();
        for (int i = 0; layout_.texture && i < 2; ++i) next();
        has_long_vertex_ = has_long_vertex_ || reader_.words().size() > 3;
        if (whole_ && !own_lines_ && reader_.words_left() > 0) {
            throw UnreadableFile("the line of a vertex has too many numbers");
        }
    }

    /// Only the end of the line tells the length of a colour. One number is an index.
    void read_vertex_color() {
        const std::size_t after = layout_.texture ? 2 : 0, left = reader_.words_left();
        if (own_lines_ && (left < after || left - after > 4)) {
            throw UnreadableFile("a colour has 0 to 4 numbers");
        }
        Words words(own_lines_ ? left - after : 4);
        for (std::string_view& word : words) word = next();
        if (words.size() >= 3) read_color(words.data(), words.size());
    }

    void read_face() {
        const std::int64_t length = integer();
        if (length < 0) throw UnreadableFile("a face has a negative number of corners");
        for (std::int64_t i = 0; i < length; ++i) {
            const std::int64_t index = integer();
            if (index < 0 || index >= static_cast<std::int64_t>(positions_.size())) {
                throw UnreadableFile("a face refers to vertex " + std::to_string(index) + " of " +
                                     std::to_string(positions_.size()) + " (counted from 0)");
            }
            polygons_.corners.push_back(static_cast<std::int32_t>(index));
        }
        polygons_.close();
        has_face_colors_ = has_face_colors_ || (own_lines_ && reader_.words_left() > 0);
    }

    TextReader reader_;
    std::string_view bytes_;  ///< of a binary file, not yet read
    std::size_t vertex_count_ = 0, face_count_ = 0;
    VertexLayout layout_;
    bool own_lines_ = false;  ///< each vertex and face begins a line; further words are no others
    bool whole_ = false;      ///< no vertex or face begins in one line and ends in another
    bool has_face_colors_ = false, has_long_vertex_ = false;
};

}  // namespace

std::unique_ptr<FileDocument> parse_off(std::string&& content) {
    return std::make_unique<OffDocument>(std::move(content));
}

void convert_to_off(std::ostream& out, const FileDocument& source, const Points& positions) {
    const std::vector<Color> colors = source.vertex_colors();
    const Polygons& polygons = source.polygons();
    out << (colors.empty() ? "OFF\n" : "COFF\n") << positions.size() << ' '
        << polygons.size_with_triangles() << " 0\n";
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Eigen::Vector3d& p = positions[i];
        out << format_number(p.x()) << ' ' << format_number(p.y()) << ' ' << format_number(p.z());
        for (std::size_t channel = 0; channel < 4 && !colors.empty(); ++channel) {
            out << ' ' << int{colors[i][channel]};
        }
        out << '\n';
    }
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        if (polygons.triangle_count(i) == 0) continue;
        out << polygons.corner_count(i);
        for (std::size_t corner = polygons.first[i]; corner < polygons.first[i + 1]; ++corner) {
            out << ' ' << polygons.corners[corner];
        }
        out << '\n';
    }
}

}  // namespace tracked_mcf
