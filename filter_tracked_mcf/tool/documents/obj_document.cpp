#include <ostream>

#include "filter_tracked_mcf/tool/documents/mesh_document.h"
#include "filter_tracked_mcf/tool/documents/number_text.h"
#include "filter_tracked_mcf/tool/documents/text_patch.h"
#include "filter_tracked_mcf/tool/file_error.h"

namespace tracked_mcf {

namespace {

using Words = std::vector<std::string_view>;

/// A part of the text that is written anew: a coordinate, or the name of a material library.
struct Slot {
    enum class Kind { Position, Normal, Library } kind;
    std::int32_t index;
    std::int32_t axis;
    std::string_view text;
};

/// Everything after the first word, blanks within it included: file names may have them.
std::string_view rest_of_line(const Words& words) {
    const char* const end = words.back().data() + words.back().size();
    return {words[1].data(), static_cast<std::size_t>(end - words[1].data())};
}

class ObjDocument : public MeshDocument {
public:
    explicit ObjDocument(std::string content) : content_(std::move(content)) {
        std::string_view rest = content_;
        for (line_ = 1; !rest.empty(); ++line_) {
            const std::size_t end = std::min(rest.find('\n'), rest.size());
            read_line(rest.substr(0, end));
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
        check_totals();
    }

    // The slots are views into the content.
    ObjDocument(const ObjDocument&) = delete;
    ObjDocument& operator=(const ObjDocument&) = delete;

    const Points& positions() const override { return positions_; }
    const Polygons& polygons() const override { return polygons_; }
    bool has_normals() const override { return !normals_.empty(); }

    void write(std::ostream& out, const Points& positions,
               const FolderChange& change) const override {
        const Points normals =
            normals_where_corners_meet(positions, polygons_, corner_normals_, normals_.size());
        TextPatch patch(out, content_);
        for (const Slot& slot : slots_) {
            const auto i = static_cast<std::size_t>(slot.index);
            if (slot.kind == Slot::Kind::Library) {
                patch.replace(slot.text, change.relocate(std::string(slot.text)));
            } else if (slot.kind == Slot::Kind::Position) {
                // What has not moved keeps its text.
                if (positions[i] == positions_[i]) continue;
                patch.replace(slot.text, format_number(positions[i][slot.axis]));
            } else if (!normals[i].isZero(0)) {
                patch.replace(slot.text, format_number(normals[i][slot.axis]));
            }
        }
        patch.finish();
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw UnreadableFile("line " + std::to_string(line_) + ": " + what);
    }

    void read_line(std::string_view line) {
        const std::size_t last = line.find_last_not_of('\r');
        if (last != std::string_view::npos && line[last] == '\\') {
            fail("it goes on after a backslash; join it with the next line");
        }
        if (line.substr(0, 5) == "#MRGB")
            polypaint_count_ += line.size() < 6 ? 0 : (line.size() - 6) / 8;
        if (line.empty() || line.front() == '#') return;
        const Words words = split_at_blanks(line);
        if (words.empty()) return;
        try {
            if (words[0] == "v")
                read_position(line, words);
            else if (words[0] == "vn")
                read_normal(words);
            else if (words[0] == "vt")
                ++texture_coordinate_count_;
            else if (words[0] == "f")
                read_face(words);
            else if (words[0] == "q")
                fail("quadrangles of the QOBJ dialect; write them as f");
            else if (words[0] == "mtllib" && words.size() > 1)
                read_library(words);
        } catch (const UnreadableFile& error) {
            const std::string what = error.what();
            if (what.compare(0, 5, "line ") == 0) throw;
            fail(what);
        }
    }

    /// The next point of `points`, with a slot for each of its coordinates.
    void read_point(const Words& words, Slot::Kind kind, Points& points) {
        Eigen::Vector3d point;
        for (std::int32_t axis = 0; axis < 3; ++axis) {
            const std::string_view word = words[static_cast<std::size_t>(axis) + 1];
            point[axis] = parse_number(word);
            slots_.push_back({kind, static_cast<std::int32_t>(points.size()), axis, word});
        }
        points.push_back(point);
    }

    void read_position(std::string_view line, const Words& words) {
        if (words.size() < 4) fail("a vertex has fewer than 3 coordinates");
        // vcglib counts only these when it makes room, and then reads all of them.
        if (line[0] != 'v' || words[1].data() - words[0].data() < 2) fail("blanks precede the v");
        read_point(words, Slot::Kind::Position, positions_);
    }

    void read_normal(const Words& words) {
        if (words.size() != 4) fail("a normal has not 3 coordinates");
        read_point(words, Slot::Kind::Normal, normals_);
    }

    void read_library(const Words& words) {
        slots_.push_back({Slot::Kind::Library, 0, 0, rest_of_line(words)});
    }

    void read_face(const Words& words) {
        for (std::size_t i = 1; i < words.size(); ++i) read_corner(words[i]);
        polygons_.close();
    }

    /// "v", "v/vt", "v//vn" or "v/vt/vn".
    void read_corner(std::string_view word) {
        const std::size_t slash = std::min(word.find('/'), word.size());
        std::string_view texture = word.substr(std::min(slash + 1, word.size()));
        const std::size_t second = std::min(texture.find('/'), texture.size());
        const std::string_view normal = texture.substr(std::min(second + 1, texture.size()));
        texture = texture.substr(0, second);

        polygons_.corners.push_back(vertex_index(word.substr(0, slash)));
        corner_normals_.push_back(normal.empty() ? -1 : any_index(normal, normals_.size()));
        last_normal_ = std::max(last_normal_, corner_normals_.back());
        if (texture.empty()) return;
        const std::int32_t coordinate = any_index(texture, texture_coordinate_count_);
        last_texture_coordinate_ = std::max(last_texture_coordinate_, coordinate);
    }

    /// Indices count from 1, negative ones from the last of the `count` so far; ours from 0.
    std::int32_t any_index(std::string_view word, std::size_t count) const {
        const std::int64_t number = parse_integer(word);
        const std::int64_t index =
            number > 0 ? number - 1 : static_cast<std::int64_t>(count) + number;
        if (number == 0 || index < 0 || index > 2147483647) {
            fail("a face has the index " + std::string(word) + ", which nothing has");
        }
        return static_cast<std::int32_t>(index);
    }

    /// Of a vertex that has been read already: vcglib does not take others.
    std::int32_t vertex_index(std::string_view word) const {
        const std::int32_t index = any_index(word, positions_.size());
        if (static_cast<std::size_t>(index) < positions_.size()) return index;
        fail("a face refers to vertex " + std::string(word) + ", but only " +
             std::to_string(positions_.size()) + " precede it");
    }

    /// Throws if faces refer to the `last`, counted from 0, and there are only `count`.
    static void check_last(std::int32_t last, std::size_t count, const char* what) {
        if (last < static_cast<std::int64_t>(count)) return;
        throw UnreadableFile("a face refers to " + std::string(what) + " " +
                             std::to_string(last + std::int64_t{1}) + " of " +
                             std::to_string(count));
    }

    void check_totals() const {
        if (positions_.empty()) throw UnreadableFile("it has no vertices");
        if (polygons_.size() == 0) throw UnreadableFile("it has no faces; a surface is needed");
        check_last(last_texture_coordinate_, texture_coordinate_count_, "vt");
        check_last(last_normal_, normals_.size(), "vn");
        // vcglib takes one for each vertex as soon as there is any.
        if (polypaint_count_ > 0 && polypaint_count_ < positions_.size()) {
            throw UnreadableFile("its #MRGB comments have fewer colours than there are vertices");
        }
    }

    std::string content_;
    std::vector<Slot> slots_;
    Points positions_, normals_;
    Polygons polygons_;
    std::vector<std::int32_t> corner_normals_;  ///< for every corner its normal, or -1
    std::size_t texture_coordinate_count_ = 0;
    std::int32_t last_texture_coordinate_ = -1, last_normal_ = -1;
    std::size_t polypaint_count_ = 0;
    std::size_t line_ = 0;
};

}  // namespace

std::unique_ptr<MeshDocument> parse_obj(std::string content) {
    return std::make_unique<ObjDocument>(std::move(content));
}

}  // namespace tracked_mcf
