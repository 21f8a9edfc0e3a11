// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/documents/binary.h"
#include "filter_tracked_mcf/hosts/cli/documents/text_document.h"
#include "filter_tracked_mcf/hosts/cli/file_error.h"

namespace tracked_mcf {

namespace {

class OffDocument : public TextDocument {
public:
    explicit OffDocument(std::string content)
        : TextDocument(std::move(content)), reader_(content_, TextReader::Syntax::Comments) {
        reader_.advance();
        if (reader_.next_word().find_first_not_of("0123456789") != std::string_view::npos) {
            read_keyword(reader_.word());
        }
        if (reader_.words_left() == 1 && lower_case(reader_.next_word()) == "binary") {
            numbers_ = Numbers::BigEndianFloats;
            bytes_ = reader_.rest();
        }
        const std::size_t vertex_count = read_count(), face_count = read_count();
        if (is_binary())
            integer();
        else
            find_rows(vertex_count + face_count);
        try {
            for (std::size_t i = 0; i < vertex_count; ++i) read_row(&OffDocument::read_vertex);
            for (std::size_t i = 0; i < face_count; ++i) read_row(&OffDocument::read_face);
            if (!is_binary()) check_end();
        } catch (const UnreadableFile& error) {
            reader_.fail(error.what() + ("; it announces " + std::to_string(vertex_count)) +
                         " vertices and " + std::to_string(face_count) +
                         " faces, but may have more or fewer");
        }
        if (has_normals_) normal_of_corner_ = polygons_.corners;
    }

    std::vector<std::string> extras() const override {
        std::vector<std::string> extras;
        if (has_normals_) extras.emplace_back("normals");
        if (texture_size_ > 0) extras.emplace_back("texture coordinates");
        if (has_face_colors_) extras.emplace_back("colours of faces");
        if (has_vertex_colors_) extras.emplace_back("colours of vertices");
        return extras;
    }

private:
    bool is_binary() const { return numbers_ == Numbers::BigEndianFloats; }

    /// The letters say what a vertex has, in any order: MeshLab writes CST where the format has
    /// STC.
    void read_keyword(std::string_view keyword) {
        const std::size_t end = keyword == "off" ? 0 : keyword.rfind("OFF");
        if (end == std::string_view::npos) {
            reader_.fail(
                "an OFF file begins with OFF, COFF, NOFF, STOFF or a combination of these");
        }
        const std::string_view letters = keyword.substr(0, end);
        if (letters.find_first_not_of("CNST") != std::string_view::npos) {
            reader_.fail("only three dimensions can be read");
        }
        has_normals_ = letters.find('N') != std::string_view::npos;
        has_vertex_colors_ = letters.find('C') != std::string_view::npos;
        texture_size_ = letters.find("ST") != std::string_view::npos ? 2 : 0;
    }

    std::size_t read_count() {
        const std::int64_t count = integer();
        if (count < 0 || count > 2147483647) reader_.fail("a count is out of range");
        return static_cast<std::size_t>(count);
    }

    /// Finds out how rows, which are vertices and faces, are divided into lines. The number of
    /// edges before them is not used, and some files lack it.
    void find_rows(std::size_t row_count) {
        if (reader_.words_left() > 0 || (reader_.find_line() && reader_.words_left() == 1))
            integer();
        if (row_count > 0 && reader_.words_left() == 0) reader_.advance();
        const std::size_t size = 3u + (has_normals_ ? 3u : 0u) + texture_size_;
        own_lines_ = reader_.words_left() >= size && reader_.count_lines() + 1 >= row_count;
        whole_ = own_lines_ || reader_.words_left() == size;
    }

    void read_row(void (OffDocument::*read)()) {
        const bool has_begun_line = reader_.words_left() < reader_.words().size();
        const bool is_next = own_lines_ ? has_begun_line : reader_.words_left() == 0;
        if (is_next && !is_binary()) reader_.advance();
        (this->*read)();
    }

    /// A vertex too many or missing must not have been taken for a face or made a face a vertex.
    void check_end() {
        const bool all_have_triangles = polygons_.size_with_triangles() == polygons_.size();
        if (own_lines_ && all_have_triangles && !has_long_vertex_) return;
        const bool has_more = (!own_lines_ && reader_.words_left() > 0) || reader_.find_line();
        if (has_more || !(own_lines_ || all_have_triangles)) {
            throw UnreadableFile("more numbers follow, or faces have fewer than 3 corners");
        }
    }

    /// Returns the next word, or the next four bytes.
    std::string_view next() {
        if (is_binary()) return take_bytes(bytes_, 1, sizeof(float));
        if (!whole_ || reader_.words_left() > 0) return reader_.word();
        throw UnreadableFile("the line has too few numbers");
    }

    std::int64_t integer() {
        const std::string_view word = next();
        return is_binary() ? number_from<std::int32_t>(reversed(word).data()) : parse_integer(word);
    }

    PointWords point() { return {next(), next(), next()}; }

    void read_vertex() {
        read_point(point(), positions_);
        if (has_normals_) read_point(point(), normals_);
        if (has_vertex_colors_) read_vertex_color();
        for (std::size_t i = 0; i < texture_size_; ++i) next();
        has_long_vertex_ = has_long_vertex_ || reader_.words().size() > 3;
        if (whole_ && !own_lines_ && reader_.words_left() > 0) {
            throw UnreadableFile("the line of a vertex has too many numbers");
        }
    }

    /// Only the end of the line tells the length of a colour.
    void read_vertex_color() {
        const std::size_t left = reader_.words_left() - texture_size_;
        if (own_lines_ && left > 4) throw UnreadableFile("a colour has 0 to 4 numbers");
        for (std::size_t i = 0; i < (own_lines_ ? left : 4); ++i) next();
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
        const auto color_size = is_binary() ? static_cast<std::size_t>(integer())
                                            : (own_lines_ ? reader_.words_left() : 0);
        has_face_colors_ = has_face_colors_ || color_size > 0;
        if (is_binary()) take_bytes(bytes_, color_size, sizeof(float));
    }

    TextReader reader_;
    std::string_view bytes_;  ///< of a binary file, not yet read
    bool has_normals_ = false, has_vertex_colors_ = false;
    std::size_t texture_size_ = 0;  ///< words of a vertex
    bool own_lines_ = false;  ///< each row begins a line, and further words of the line are no row
    bool whole_ = false;      ///< no row begins in one line and ends in another
    bool has_face_colors_ = false, has_long_vertex_ = false;
};

}  // namespace

std::unique_ptr<FileDocument> parse_off(std::string&& content) {
    return std::make_unique<OffDocument>(std::move(content));
}

}  // namespace tracked_mcf
