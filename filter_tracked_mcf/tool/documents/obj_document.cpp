// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <set>

#include "filter_tracked_mcf/tool/documents/text.h"
#include "filter_tracked_mcf/tool/documents/text_document.h"
#include "filter_tracked_mcf/tool/file_error.h"

namespace tracked_mcf {

namespace {

class ObjDocument : public TextDocument {
public:
    explicit ObjDocument(std::string content) : TextDocument(std::move(content)) {
        for (WordReader reader(content_); reader.has_more();) read_line(reader);
        check_totals();
    }

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

    /// "v x y z", and in many files red, green and blue as well, up to 1 or up to 255.
    void read_vertex(Words words) {
        const auto is_remark = [](std::string_view word) { return word.front() == '#'; };
        words.erase(std::find_if(words.begin(), words.end(), is_remark), words.end());
        if (words.size() < 4) throw UnreadableFile("a vertex has fewer than 3 coordinates");
        read_point({words[1], words[2], words[3]}, positions_);
        if (words.size() < 7) return;
        std::vector<double> channels;
        for (std::size_t i = 4; i < 7; ++i) channels.push_back(parse_number(words[i]));
        const double largest = *std::max_element(channels.begin(), channels.end());
        set_color(make_color(channels, largest > 1 ? 255 : 1));
    }

    void read_normal(const Words& words) {
        if (words.size() != 4) throw UnreadableFile("a normal has not 3 coordinates");
        read_point({words[1], words[2], words[3]}, normals_);
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
        normal_of_corner_.push_back(normal.empty() ? -1
                                                   : zero_based_index(normal, normals_.size()));
        last_normal_ = std::max(last_normal_, normal_of_corner_.back());
        if (texture.empty()) return;
        const std::int32_t coordinate = zero_based_index(texture, texture_coordinate_count_);
        last_texture_coordinate_ = std::max(last_texture_coordinate_, coordinate);
    }

    /// Returns an index counted from 0. Files count from 1, or with negative numbers from the last
    /// of the `count` so far.
    static std::int32_t zero_based_index(std::string_view word, std::size_t count) {
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
        const std::int32_t index = zero_based_index(word, positions_.size());
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

    std::set<std::string_view> keywords_;  ///< the first words of all lines
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
