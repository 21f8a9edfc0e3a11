#include "filter_tracked_mcf/tool/documents/stl_check.h"

#include <cstdint>
#include <cstring>
#include <string>

#include "filter_tracked_mcf/tool/documents/mesh_document.h"
#include "filter_tracked_mcf/tool/file_error.h"

namespace tracked_mcf {

namespace {

constexpr std::size_t kHeaderSize = 84, kTriangleSize = 50;

/// What is wrong, or nothing.
std::string problem_of_ascii(std::string_view content) {
    if (content.find('\n') == std::string_view::npos) return "it is a single line";
    if (content.find("endsolid") == std::string_view::npos) {
        return "it ends before 'endsolid'; it is truncated";
    }
    const bool has_triangles = content.find("facet") != std::string_view::npos;
    if (!has_triangles || content.size() < kHeaderSize) return "it has no triangles";
    return {};
}

std::string problem_of_binary(std::string_view content) {
    if (content.size() < kHeaderSize) return "it is neither a binary nor an ASCII STL file";
    std::uint32_t count = 0;
    std::memcpy(&count, content.data() + kHeaderSize - sizeof count, sizeof count);
    if (count == 0) return "it has no triangles";
    const std::size_t announced = kHeaderSize + kTriangleSize * count;
    if (content.size() == announced) return {};
    return "it announces " + std::to_string(count) + " triangles, which take " +
           std::to_string(announced) + " bytes, but it has " + std::to_string(content.size());
}

std::string problem_of(std::string_view content) {
    if (content.empty()) return "it is empty";
    const std::string binary_problem = problem_of_binary(content);
    // Binary files exist that begin with "solid": the size decides first.
    if (binary_problem.empty()) return {};
    const bool is_ascii =
        content.substr(0, 5) == "solid" && content.find('\0') == std::string_view::npos;
    return is_ascii ? problem_of_ascii(content) : binary_problem;
}

}  // namespace

void check_stl(const std::filesystem::path& path) {
    const std::string problem = problem_of(read_whole_file(path));
    if (problem.empty()) return;
    throw UnreadableFile(path.string() + " cannot be used: " + problem +
                         ". Repair the file or export the mesh again.");
}

}  // namespace tracked_mcf
