#include <algorithm>
#include <ostream>

#include "filter_tracked_mcf/tool/documents/mesh_document.h"
#include "filter_tracked_mcf/tool/documents/number_text.h"
#include "filter_tracked_mcf/tool/documents/text_patch.h"
#include "filter_tracked_mcf/tool/file_error.h"

namespace tracked_mcf {

namespace {

using Words = std::vector<std::string_view>;

/// The words of an OFF file, line after line, in the way in which vcglib goes through them.
class Lines {
public:
    explicit Lines(std::string_view text) : rest_(text) {}

    /// Goes to the next line that is neither empty nor a comment.
    void advance() {
        std::string_view line;
        do {
            if (rest_.empty()) throw UnreadableFile("it ends too early; it is truncated");
            const std::size_t end = std::min(rest_.find('\n'), rest_.size());
            line = rest_.substr(0, end);
            rest_.remove_prefix(std::min(end + 1, rest_.size()));
            ++number_;
        } while (line.empty() || line.front() == '#' || line.front() == '\r');
        words_ = split_at_blanks(line);
        next_ = 0;
        if (words_.empty()) fail("it has nothing but blanks");
    }

    /// The next word, from the next line where this one has no more.
    std::string_view word() {
        if (next_ == words_.size()) advance();
        return words_[next_++];
    }

    std::size_t words_left() const { return words_.size() - next_; }
    void skip(std::size_t count) { next_ += count; }

    [[noreturn]] void fail(const std::string& what) const {
        throw UnreadableFile("line " + std::to_string(number_) + ": " + what);
    }

private:
    std::string_view rest_;
    Words words_;
    std::size_t next_ = 0, number_ = 0;
};

/// What a vertex has besides coordinates, as the header's keyword says.
struct VertexLayout {
    bool normal = false, color = false, texture = false;
};

/// Takes the letters in any order: vcglib writes CST where the format has STC.
VertexLayout parse_keyword(const Lines& lines, std::string_view keyword) {
    const std::size_t end = keyword.rfind("OFF");
    if (end == std::string_view::npos) {
        lines.fail("an OFF file begins with OFF, COFF, NOFF, STOFF or a combination of these");
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
            lines.fail("only three dimensions can be read");
        prefix.remove_prefix(texture ? 2 : 1);
    }
    return layout;
}

std::string keyword_of(const VertexLayout& layout) {
    return std::string(layout.texture ? "ST" : "") + (layout.color ? "C" : "") +
           (layout.normal ? "N" : "") + "OFF";
}

class OffDocument : public MeshDocument {
public:
    explicit OffDocument(std::string content) : content_(std::move(content)) {
        Lines lines(content_);
        lines.advance();
        keyword_ = lines.word();
        layout_ = parse_keyword(lines, keyword_);
        if (lines.words_left() == 0) lines.advance();
        const std::size_t vertex_count = read_count(lines), face_count = read_count(lines);
        read_count(lines);  // of the edges: nobody uses it
        if (vertex_count == 0) throw UnreadableFile("it has no vertices");
        if (face_count == 0) throw UnreadableFile("it has no faces; a surface is needed");
        lines.advance();
        for (std::size_t i = 0; i < vertex_count; ++i) read_vertex(lines);
        for (std::size_t i = 0; i < face_count; ++i) read_face(lines);
    }

    // The coordinates' texts are views into the content.
    OffDocument(const OffDocument&) = delete;
    OffDocument& operator=(const OffDocument&) = delete;

    const Points& positions() const override { return positions_; }
    const Polygons& polygons() const override { return polygons_; }
    bool has_normals() const override { return layout_.normal; }

    void write(std::ostream& out, const Points& positions, const FolderChange&) const override {
        Points normals;
        if (layout_.normal) {
            normals = normals_where_corners_meet(positions, polygons_, polygons_.corners,
                                                 positions.size());
        }
        TextPatch patch(out, content_);
        patch.replace(keyword_, keyword_of(layout_));
        auto text = numbers_.begin();
        for (std::size_t i = 0; i < positions.size(); ++i) {
            // What has not moved keeps its text.
            const bool moved = positions[i] != positions_[i];
            text = write_point(patch, text, positions[i], moved);
            if (layout_.normal) text = write_point(patch, text, normals[i], !normals[i].isZero(0));
        }
        patch.finish();
    }

private:
    using Texts = std::vector<std::string_view>;

    static Texts::const_iterator write_point(TextPatch& patch, Texts::const_iterator text,
                                             const Eigen::Vector3d& point, bool changed) {
        for (int axis = 0; axis < 3; ++axis, ++text) {
            if (changed) patch.replace(*text, format_number(point[axis]));
        }
        return text;
    }

    static std::size_t read_count(Lines& lines) {
        if (lines.words_left() == 0) lines.fail("it should have 3 counts");
        const std::int64_t count = parse_integer(lines.word());
        if (count < 0 || count > 2147483647) lines.fail("a count is out of range");
        return static_cast<std::size_t>(count);
    }

    Eigen::Vector3d read_point(Lines& lines) {
        Eigen::Vector3d point;
        for (int axis = 0; axis < 3; ++axis) {
            numbers_.push_back(lines.word());
            point[axis] = parse_number(numbers_.back());
        }
        return point;
    }

    void read_vertex(Lines& lines) {
        positions_.push_back(read_point(lines));
        if (layout_.normal) read_point(lines);
        if (layout_.color) skip_vertex_color(lines);
        for (int i = 0; layout_.texture && i < 2; ++i) parse_number(lines.word());
    }

    /// A colour ends with its line, but for texture coordinates: nothing else tells how long it is.
    void skip_vertex_color(Lines& lines) const {
        const std::size_t texture = layout_.texture ? 2 : 0;
        const std::size_t left = lines.words_left();
        if (left < texture || left - texture > 4) lines.fail("a colour has 0 to 4 numbers");
        check_color(lines, left - texture);
    }

    void read_face(Lines& lines) {
        lines.advance();
        const std::int64_t length = parse_integer(lines.word());
        if (length < 0) lines.fail("a face has a negative number of corners");
        for (std::int64_t i = 0; i < length; ++i) {
            const std::int64_t index = parse_integer(lines.word());
            if (index < 0 || index >= static_cast<std::int64_t>(positions_.size())) {
                lines.fail("a face refers to vertex " + std::to_string(index) + " of " +
                           std::to_string(positions_.size()) + " (counted from 0)");
            }
            polygons_.corners.push_back(static_cast<std::int32_t>(index));
        }
        polygons_.close();
        check_color(lines, lines.words_left());
    }

    /// A single number is an index, which vcglib looks up without a look at its range.
    static void check_color(Lines& lines, std::size_t length) {
        if (length == 1) {
            const std::int64_t index = parse_integer(lines.word());
            if (index < 0 || index > 147) lines.fail("a colour index is not within 0 to 147");
        } else {
            lines.skip(length);
        }
    }

    std::string content_;
    std::string_view keyword_;
    VertexLayout layout_;
    Texts numbers_;  ///< of every vertex: the coordinates, then those of its normal
    Points positions_;
    Polygons polygons_;
};

}  // namespace

std::unique_ptr<MeshDocument> parse_off(std::string content) {
    return std::make_unique<OffDocument>(std::move(content));
}

}  // namespace tracked_mcf
