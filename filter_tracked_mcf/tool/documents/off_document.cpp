// SPDX-License-Identifier: GPL-3.0-or-later
#include <ostream>

#include "filter_tracked_mcf/tool/documents/text.h"
#include "filter_tracked_mcf/tool/documents/text_document.h"
#include "filter_tracked_mcf/tool/file_error.h"

namespace tracked_mcf {

namespace {

/// What a vertex has besides coordinates, as the header's keyword says.
struct VertexLayout {
    bool normal = false, color = false, texture = false;
};

/// Takes the letters in any order: MeshLab writes CST where the format has STC.
VertexLayout parse_keyword(const WordReader& words, std::string_view keyword) {
    const std::size_t end = keyword.rfind("OFF");
    if (end == std::string_view::npos) {
        words.fail("an OFF file begins with OFF, COFF, NOFF, STOFF or a combination of these");
    }
    VertexLayout layout;
    for (std::string_view prefix = keyword.substr(0, end); !prefix.empty();) {
        const bool texture = prefix.substr(0, 2) == "ST";
        if (texture)
            layout.texture = true;
        else if (prefix.front() == 'C')
            layout.color = true;
        else if (prefix.front() == 'N')
            layout.normal = true;
        else
            words.fail("only three dimensions can be read");
        prefix.remove_prefix(texture ? 2 : 1);
    }
    return layout;
}

class OffDocument : public TextDocument {
public:
    explicit OffDocument(std::string content) : TextDocument(std::move(content)) {
        WordReader words(content_);
        layout_ = parse_keyword(words, words.word());
        if (words.words_left() == 0) words.advance();
        const std::size_t vertex_count = read_count(words), face_count = read_count(words);
        read_count(words);  // the number of edges is not used
        if (vertex_count == 0) throw UnreadableFile("it has no vertices");
        if (face_count == 0) throw UnreadableFile("it has no faces; a surface is needed");
        words.advance();
        for (std::size_t i = 0; i < vertex_count; ++i) read_vertex(words);
        for (std::size_t i = 0; i < face_count; ++i) read_face(words);
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
    static std::size_t read_count(WordReader& words) {
        if (words.words_left() == 0) words.fail("it should have 3 counts");
        const std::int64_t count = parse_integer(words.word());
        if (count < 0 || count > 2147483647) words.fail("a count is out of range");
        return static_cast<std::size_t>(count);
    }

    void read_vertex(WordReader& words) {
        read_point({words.word(), words.word(), words.word()}, positions_);
        if (layout_.normal) read_point({words.word(), words.word(), words.word()}, normals_);
        if (layout_.color) read_vertex_color(words);
        for (int i = 0; layout_.texture && i < 2; ++i) parse_number(words.word());
    }

    /// Reads a colour, whose length only the end of the line tells.
    void read_vertex_color(WordReader& words) {
        const std::size_t after = layout_.texture ? 2 : 0, left = words.words_left();
        if (left < after || left - after > 4) words.fail("a colour has 0 to 4 numbers");
        if (left - after < 3) return check_color(words, words.take(left - after));
        bool has_point = false;
        std::vector<double> channels;
        for (const std::string_view word : words.take(left - after)) {
            channels.push_back(parse_number(word));
            has_point = has_point || word.find('.') != std::string_view::npos;
        }
        set_color(make_color(channels, has_point ? 1 : 255));
    }

    void read_face(WordReader& words) {
        words.advance();
        const std::int64_t length = parse_integer(words.word());
        if (length < 0) words.fail("a face has a negative number of corners");
        for (std::int64_t i = 0; i < length; ++i) {
            const std::int64_t index = parse_integer(words.word());
            if (index < 0 || index >= static_cast<std::int64_t>(positions_.size())) {
                words.fail("a face refers to vertex " + std::to_string(index) + " of " +
                           std::to_string(positions_.size()) + " (counted from 0)");
            }
            polygons_.corners.push_back(static_cast<std::int32_t>(index));
        }
        polygons_.close();
        has_face_colors_ = has_face_colors_ || words.words_left() > 0;
        check_color(words, words.take(words.words_left()));
    }

    /// A single number is an index into the 148 colours of Geomview.
    static void check_color(const WordReader& reader, const Words& words) {
        if (words.size() != 1) return;
        const std::int64_t index = parse_integer(words[0]);
        if (index < 0 || index > 147) reader.fail("a colour index is not within 0 to 147");
    }

    VertexLayout layout_;
    bool has_face_colors_ = false;
};

}  // namespace

std::unique_ptr<FileDocument> parse_off(std::string&& content) {
    return std::make_unique<OffDocument>(std::move(content));
}

void convert_to_off(std::ostream& out, const FileDocument& source, const Points& positions) {
    const std::vector<Color> colors = source.vertex_colors();
    const Polygons& polygons = source.polygons();
    out << (colors.empty() ? "OFF\n" : "COFF\n") << positions.size() << ' ' << polygons.size()
        << " 0\n";
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Eigen::Vector3d& p = positions[i];
        out << format_number(p.x()) << ' ' << format_number(p.y()) << ' ' << format_number(p.z());
        for (std::size_t channel = 0; channel < 4 && !colors.empty(); ++channel) {
            out << ' ' << int{colors[i][channel]};
        }
        out << '\n';
    }
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        out << polygons.corner_count(i);
        for (std::size_t corner = polygons.first[i]; corner < polygons.first[i + 1]; ++corner) {
            out << ' ' << polygons.corners[corner];
        }
        out << '\n';
    }
}

}  // namespace tracked_mcf
