// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <map>
#include <set>

#include "filter_tracked_mcf/hosts/cli/documents/text_document.h"
#include "filter_tracked_mcf/hosts/cli/file_error.h"

namespace tracked_mcf {

namespace {

class ObjDocument : public TextDocument {
public:
    explicit ObjDocument(std::string content) : TextDocument(std::move(content)) {
        TextReader reader(content_, TextReader::Syntax::CommentsAndContinuedLines);
        while (reader.find_line()) {
            try {
                read_line(reader);
            } catch (const UnreadableFile& error) {
                reader.fail(error.what());
            }
        }
        // Vertices and normals may follow the faces that refer to them.
        if (last_index_ >= static_cast<std::int64_t>(positions_.size())) {
            throw UnreadableFile("line " + std::to_string(line_of_last_index_) +
                                 ": a face refers to vertex " +
                                 std::to_string(last_index_ + std::int64_t{1}) + " of " +
                                 std::to_string(positions_.size()));
        }
        for (std::int32_t& normal : normal_of_corner_) {
            if (normal >= static_cast<std::int64_t>(normals_.size())) normal = -1;
        }
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
            extras.insert(name == names.end() ? std::string(keyword) : name->second);
        }
        if (!normals_.empty()) extras.insert(names.at("vn"));
        if (has_colors_) extras.insert("colours of vertices");
        return {extras.begin(), extras.end()};
    }

private:
    void read_line(const TextReader& reader) {
        const Words& words = reader.words();
        if (words[0] == "v")
            read_vertex(words);
        else if (words[0] == "vn" && words.size() >= 4)
            read_point({words[1], words[2], words[3]}, normals_);
        else if (words[0] == "vn")
            throw UnreadableFile("a normal does not have 3 coordinates");
        else if (words[0] == "f")
            read_face(words, reader.line_number());
        else if (words[0] == "q")
            throw UnreadableFile("quadrangles of the QOBJ dialect; write them as f");
        else
            keywords_.insert(words[0]);
    }

    /// "v x y z", and in many files red, green and blue as well. z may be missing.
    void read_vertex(const Words& words) {
        if (words.size() < 3) throw UnreadableFile("a vertex has fewer than 2 coordinates");
        const std::string_view y = words[2];
        read_point({words[1], y, words.size() > 3 ? words[3] : y.substr(y.size())}, positions_);
        has_colors_ = has_colors_ || words.size() >= 7;
    }

    void read_face(const Words& words, std::size_t line) {
        for (std::size_t i = 1; i < words.size(); ++i) {
            read_corner(words[i]);
            if (polygons_.corners.back() <= last_index_) continue;
            last_index_ = polygons_.corners.back();
            line_of_last_index_ = line;
        }
        polygons_.close();
    }

    /// "v", "v/vt", "v//vn" or "v/vt/vn".
    void read_corner(std::string_view word) {
        const std::size_t slash = std::min(word.find('/'), word.size());
        const std::string_view rest = word.substr(std::min(slash + 1, word.size()));
        const std::size_t second = std::min(rest.find('/'), rest.size());
        const std::string_view normal = rest.substr(std::min(second + 1, rest.size()));
        if (second > 0) zero_based_index(rest.substr(0, second), 0);
        constexpr std::int64_t largest_index = 2147483647;
        const std::int64_t vertex = zero_based_index(word.substr(0, slash), positions_.size());
        if (vertex < 0 || vertex > largest_index) {
            throw UnreadableFile("a face refers to vertex " + std::string(word) + ", but only " +
                                 std::to_string(positions_.size()) + " precede it");
        }
        polygons_.corners.push_back(static_cast<std::int32_t>(vertex));
        const std::int64_t index = normal.empty() ? -1 : zero_based_index(normal, normals_.size());
        normal_of_corner_.push_back(
            static_cast<std::int32_t>(std::clamp<std::int64_t>(index, -1, largest_index)));
    }

    /// Returns an index counted from 0. Files count from 1, or with negative numbers from the last
    /// of the `count` so far.
    static std::int64_t zero_based_index(std::string_view word, std::size_t count) {
        const std::int64_t number = parse_integer(word);
        if (number == 0) throw UnreadableFile("a face has the index 0, which nothing has");
        return number > 0 ? number - 1 : static_cast<std::int64_t>(count) + number;
    }

    std::set<std::string_view> keywords_;  ///< the first words of other lines
    bool has_colors_ = false;              ///< of vertices
    std::int32_t last_index_ = -1;
    std::size_t line_of_last_index_ = 0;
};

}  // namespace

std::unique_ptr<FileDocument> parse_obj(std::string&& content) {
    return std::make_unique<ObjDocument>(std::move(content));
}

}  // namespace tracked_mcf
