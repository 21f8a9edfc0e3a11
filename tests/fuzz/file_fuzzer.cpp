// SPDX-License-Identifier: GPL-3.0-or-later
// Reads bytes as a file of the format TRACKED_MCF_FORMAT. A file that is not refused is written
// in its own format, with the same positions and with other ones, and as PLY and STL. The program
// reads each result again.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/hosts/cli/documents/file_document.h"
#include "filter_tracked_mcf/hosts/cli/file_error.h"

namespace tracked_mcf {
namespace {

void require(bool holds, const std::string& what) {
    if (holds) return;
    std::cerr << "failed: " << what << '\n';
    std::abort();
}

/// Returns a document for a file's content, or null if it is refused.
std::unique_ptr<FileDocument> parsed(const Format& format, std::string content) {
    try {
        return parse_document(format, std::move(content));
    } catch (const UnreadableFile&) {
        return nullptr;
    }
}

void check_result(const Format& format, const std::string& content, const FileDocument& source) {
    const auto result = parsed(format, content);
    require(result != nullptr, std::string("the result is refused: ") + format.extension);
    require(result->polygons().size_with_triangles() >= source.polygons().size_with_triangles(),
            "polygons are missing");
}

bool is_finite(const Points& positions) {
    for (const auto& position : positions) {
        if (!position.allFinite()) return false;
    }
    return true;
}

void fuzz(const std::string& content) {
    const Format& format = *format_of("a" TRACKED_MCF_FORMAT);
    const auto document = parsed(format, content);
    if (!document) return;
    const auto vertex_count = static_cast<std::int64_t>(document->positions().size());
    for (const Triangle& triangle : fans(document->polygons())) {
        for (const std::int32_t vertex : triangle) {
            require(vertex >= 0 && vertex < vertex_count, "an index is out of range");
        }
    }
    document->extras();
    // The program does not write a mesh that evolve() refuses.
    if (!is_finite(document->positions())) return;

    Points moved = document->positions();
    const auto write_in_same_format = [&] {
        std::ostringstream out;
        document->write(out, moved);
        check_result(format, out.str(), *document);
        return out.str();
    };
    const std::string kept = write_in_same_format();
    if (kept != content) {
        // Whole numbers as coordinates of a PLY file have become doubles.
        std::ostringstream kept_again;
        parsed(format, kept)->write(kept_again, document->positions());
        require(kept_again.str() == kept, "what does not move is not kept to the letter");
    }
    for (auto& position : moved) position.x() += 1;
    write_in_same_format();
    document->set_quality(std::vector<double>(document->positions().size(), 0.5));
    write_in_same_format();
    for (const char* name : {"a.ply", "a.stl"}) {
        const Format& other = *format_of(name);
        std::ostringstream converted;
        other.convert(converted, *document, document->positions());
        check_result(other, converted.str(), *document);
    }
}

}  // namespace
}  // namespace tracked_mcf

// NOLINTNEXTLINE(readability-identifier-naming): libFuzzer gives the name
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;  // open_document() refuses empty files
    tracked_mcf::fuzz({reinterpret_cast<const char*>(data), size});
    return 0;
}
