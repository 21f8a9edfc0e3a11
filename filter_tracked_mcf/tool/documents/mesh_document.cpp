#include "filter_tracked_mcf/tool/documents/mesh_document.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "filter_tracked_mcf/tool/file_error.h"

namespace tracked_mcf {

namespace fs = std::filesystem;

std::string FolderChange::relocate(const std::string& name) const {
    if (name.empty() || fs::path(name).is_absolute()) return name;
    const fs::path old_place = fs::weakly_canonical(from), new_place = fs::weakly_canonical(to);
    if (old_place == new_place) return name;
    return (old_place / name).lexically_normal().lexically_proximate(new_place).generic_string();
}

std::string lower_case_extension(const fs::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return extension;
}

std::string read_whole_file(const fs::path& path) {
    if (fs::is_directory(path)) {
        throw UnreadableFile(path.string() + " is a folder; give a mesh file.");
    }
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::ostringstream content;
    // Inserting nothing at all sets the fail bit: an empty file is not a failure.
    if (file && file.peek() != std::ifstream::traits_type::eof()) content << file.rdbuf();
    if (!file.is_open() || file.bad() || !content) {
        throw UnreadableFile("cannot read " + path.string() + ": " + std::strerror(errno) +
                             "; check the name and the permissions.");
    }
    return content.str();
}

namespace {

std::unique_ptr<MeshDocument> parse(const std::string& extension, std::string content) {
    if (content.empty()) throw UnreadableFile("it is empty");
    if (extension == ".ply") return parse_ply(content);
    if (extension == ".obj") return parse_obj(std::move(content));
    return parse_off(std::move(content));
}

void check_corner_counts(const Polygons& polygons) {
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        if (polygons.corner_count(i) >= 3) continue;
        throw UnreadableFile("face " + std::to_string(i) + " (counted from 0) has " +
                             std::to_string(polygons.corner_count(i)) +
                             " corners, at least 3 are needed");
    }
}

}  // namespace

std::unique_ptr<MeshDocument> open_document(const fs::path& path) {
    std::string content = read_whole_file(path);
    try {
        auto document = parse(lower_case_extension(path), std::move(content));
        check_corner_counts(document->polygons());
        return document;
    } catch (const UnreadableFile& error) {
        throw UnreadableFile(path.string() + " cannot be used: " + error.what() +
                             ". Repair the file or export the mesh again.");
    }
}

}  // namespace tracked_mcf
