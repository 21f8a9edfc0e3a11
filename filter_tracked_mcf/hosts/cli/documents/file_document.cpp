// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/documents/file_document.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "filter_tracked_mcf/hosts/cli/documents/text.h"
#include "filter_tracked_mcf/hosts/cli/file_error.h"

namespace tracked_mcf {

namespace fs = std::filesystem;

namespace {

constexpr std::array<Format, 4> kFormats = {{{".ply", parse_ply, convert_to_ply, true},
                                             {".obj", parse_obj, nullptr, false},
                                             {".off", parse_off, nullptr, false},
                                             {".stl", parse_stl, convert_to_stl, false}}};

[[noreturn]] void fail_to_read(const fs::path& path, const std::string& why) {
    throw UnreadableFile("cannot read " + path.u8string() + ": " + why +
                         "; check the name and the permissions.");
}

/// Reads a file or a pipe from beginning to end, once.
std::string read_whole_file(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (error) fail_to_read(path, error.message());
    if (fs::is_directory(status)) {
        throw UnreadableFile(path.u8string() + " is a folder; give a mesh file.");
    }
    // A device such as /dev/zero may have no end.
    if (fs::is_character_file(status) || fs::is_block_file(status)) {
        throw UnreadableFile(path.u8string() + " is a device; give a mesh file.");
    }
    std::string content;
    const auto size = fs::file_size(path, error);
    if (!error) content.reserve(size);
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::vector<char> buffer(1 << 16);
    while (file) {
        file.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
        content.append(buffer.data(), static_cast<std::size_t>(file.gcount()));
    }
    if (!file.eof()) fail_to_read(path, std::strerror(errno));
    return content;
}

}  // namespace

const Format* format_of(const fs::path& path) {
    const std::string extension = lower_case(path.extension().u8string());
    for (const Format& format : kFormats) {
        if (extension == format.extension) return &format;
    }
    return nullptr;
}

std::unique_ptr<FileDocument> parse_document(const Format& format, std::string&& content) {
    if (content.empty()) throw UnreadableFile("it is empty");
    auto document = format.parse(std::move(content));
    const Polygons& polygons = document->polygons();
    if (document->positions().empty()) throw UnreadableFile("it has no vertices");
    if (polygons.size() == 0) throw UnreadableFile("it has no faces; a surface is needed");
    if (polygons.size_with_triangles() == 0) {
        throw UnreadableFile("none of its " + std::to_string(polygons.size()) +
                             " faces has 3 corners or more; a surface is needed");
    }
    return document;
}

std::unique_ptr<FileDocument> open_document(const fs::path& path) {
    std::string content = read_whole_file(path);
    const Format* const format = format_of(path);
    try {
        if (!format) throw UnreadableFile("its extension is not .ply, .obj, .off or .stl");
        return parse_document(*format, std::move(content));
    } catch (const UnreadableFile& error) {
        throw UnreadableFile(path.u8string() + " cannot be used: " + error.what() +
                             ". Repair the file or export the mesh again.");
    }
}

}  // namespace tracked_mcf
