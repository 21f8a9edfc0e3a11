// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <set>

#include "filter_tracked_mcf/tool/documents/file_document.h"
#include "filter_tracked_mcf/tool/documents/text.h"
#include "filter_tracked_mcf/tool/file_error.h"

namespace tracked_mcf {

namespace {

/// A coordinate in the text, which is written anew.
struct Slot {
    bool is_normal;
    std::int32_t index;
    std::int32_t axis;
    std::string_view text;
};

class ObjDocument : public FileDocument {
public:
    explicit ObjDocument(std::string content) : content_(std::move(content)) {
        for (WordReader reader(content_); reader.has_more();) read_line(reader);
        check_totals();
        if (!colors_.empty()) colors_.resize(positions_.size(), kWhite);
    }

    std::vector<Color> vertex_colors() const override { return colors_; }

    std::vector<std::string> extras() const override {
        static const std::map<std::string_view, std::string> names = {
            {"vn", "normals"},       {"vt", "texture coordinates"},
            {"mtllib", "materials"}, {"usemtl", "materials"},
            {"o", "objects"},        {"g", "groups"},
            {"s", "smoothing"},      {"l", "lines"}};
        std::set<std::string> extras;
        for (const std::string_view keyword : keywords_) {
            const auto name = names.find(keyword);
            if (name != names.end())
                extras.insert(name->second);
            else if (keyword != "v" && keyword != "f")
                extras.insert(std::string(keyword));
        }
        return {extras.begin(), extras.end()};
    }

    void write(std::ostream& out, const Points& positions) const override {
        const Points normals =
            corner_normals(positions, polygons_, normal_of_corner_, normals_.size());
        TextPatch patch(out, content_);
        for (const Slot& slot : slots_) {
            const auto i = static_cast<std::size_t>(slot.index);
            // A vertex that has not moved keeps its text.
            const bool keeps_text =
                slot.is_normal ? normals[i].isZero(0) : positions[i] == positions_[i];
            if (keeps_text) continue;
            const Points& points = slot.is_normal ? normals : positions;
            patch.replace(slot.text, format_number(points[i][slot.axis]));
        }
        patch.finish();
    }

private:
    void read_line(WordReader& reader) {
        const Words words = reader.take(reader.words_left());
        if (words.back().back() == '\\') {
            reader.fail("it goes on after a backslash; join it with the next line");
        }
        keywords_.insert(words[0]);
        try {
            if (words[0] == "v")
                read_vertex(words);
            else if (words[0] == "vn")
                read_normal(words);
            else if (words[0] == "vt")
                ++texture_coordinate_count_;
            else if (words[0] == "f")
                read_face(words);
            else if (words[0] == "q")
                throw UnreadableFile("quadrangles of the QOBJ dialect; write them as f");
        } catch (const UnreadableFile& error) {
            reader.fail(error.what());
        }
    }

    /// Reads a point, with a slot for each of its coordinates.
    void read_point(const Words& words, Points& points) {
        Eigen::Vector3d point;
        for (std::int32_t axis = 0; axis < 3; ++axis) {
            const std::string_view word = words[static_cast<std::size_t>(axis) + 1];
            point[axis] = parse_number(word);
            slots_.push_back(
                {&points == &normals_, static_cast<std::int32_t>(points.size()), axis, word});
        }
        points.push_back(point);
    }

    /// "v x y z", and in many files red, green and blue as well, up to 1 or up to 255.
    void read_vertex(Words words) {
        const auto is_remark = [](std::string_view word) { return word.front() == '#'; };
        words.erase(std::find_if(words.begin(), words.end(), is_remark), words.end());
        if (words.size() < 4) throw UnreadableFile("a vertex has fewer than 3 coordinates");
        read_point(words, positions_);
        if (words.size() < 7) return;
        std::vector<double> channels;
        for (std::size_t i = 4; i < 7; ++i) channels.push_back(parse_number(words[i]));
        const double largest = *std::max_element(channels.begin(), channels.end());
        colors_.resize(positions_.size(), kWhite);
        colors_.back() = make_color(channels, largest > 1 ? 255 : 1);
    }

    void read_normal(const Words& words) {
        if (words.size() != 4) throw UnreadableFile("a normal has not 3 coordinates");
        read_point(words, normals_);
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
        normal_of_corner_.push_back(normal.empty() ? -1 : any_index(normal, normals_.size()));
        last_normal_ = std::max(last_normal_, normal_of_corner_.back());
        if (texture.empty()) return;
        const std::int32_t coordinate = any_index(texture, texture_coordinate_count_);
        last_texture_coordinate_ = std::max(last_texture_coordinate_, coordinate);
    }

    /// Returns an index counted from 0. Files count from 1, or with negative numbers from the last
    /// of the `count` so far.
    static std::int32_t any_index(std::string_view word, std::size_t count) {
        const std::int64_t number = parse_integer(word);
        const std::int64_t index =
            number > 0 ? number - 1 : static_cast<std::int64_t>(count) + number;
        if (number == 0 || index < 0 || index > 2147483647) {
            throw UnreadableFile("a face has the index " + std::string(word) +
                                 ", which nothing has");
        }
        return static_cast<std::int32_t>(index);
    }

    std::int32_t vertex_index(std::string_view word) const {
        const std::int32_t index = any_index(word, positions_.size());
        if (static_cast<std::size_t>(index) < positions_.size()) return index;
        throw UnreadableFile("a face refers to vertex " + std::string(word) + ", but only " +
                             std::to_string(positions_.size()) + " precede it");
    }

    /// Throws if `last`, the largest index in the faces, counted from 0, is not less than `count`.
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
    }

    std::string content_;
    std::vector<Slot> slots_;  ///< views into the content
    Points normals_;
    std::vector<Color> colors_;                   ///< of every vertex, or empty
    std::vector<std::int32_t> normal_of_corner_;  ///< or -1
    std::set<std::string_view> keywords_;         ///< the first words of all lines
    std::size_t texture_coordinate_count_ = 0;
    std::int32_t last_texture_coordinate_ = -1, last_normal_ = -1;
};

}  // namespace

std::unique_ptr<FileDocument> parse_obj(std::string&& content) {
    return std::make_unique<ObjDocument>(std::move(content));
}

void convert_to_obj(std::ostream& out, const FileDocument& source, const Points& positions) {
    const std::vector<Color> colors = source.vertex_colors();
    for (std::size_t i = 0; i < positions.size(); ++i) {
        out << 'v';
        for (int axis = 0; axis < 3; ++axis) out << ' ' << format_number(positions[i][axis]);
        // Four digits tell 256 levels apart.
        for (std::size_t channel = 0; channel < 3 && !colors.empty(); ++channel) {
            out << ' ' << format_number(std::round(colors[i][channel] / 255.0 * 1e4) / 1e4);
        }
        out << '\n';
    }
    const Polygons& polygons = source.polygons();
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        out << 'f';
        for (std::size_t corner = polygons.first[i]; corner < polygons.first[i + 1]; ++corner) {
            out << ' ' << polygons.corners[corner] + 1;
        }
        out << '\n';
    }
}

}  // namespace tracked_mcf
