#pragma once

#include "filter_tracked_mcf/tool/vcglib_mesh.h"

#include <wrap/io_trimesh/import_obj.h>
#include <wrap/io_trimesh/import_stl.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

/// Repairs of vcglib's OBJ and STL readers, for our mesh type alone: members of their class
/// templates that do not do what their callers count on, specialised.
namespace tracked_mcf {

/// Any other mesh type: its OBJ reader is vcglib's own, which the repairs below call.
class UnrepairedMesh : public VcglibMesh {};

/// Whether an STL file, which has been checked, is binary: by its size. vcglib looks for bytes that
/// are no text as well, 2020.09 in an array that it has not filled, and so takes short ASCII files
/// for binary ones now and then.
inline bool is_binary_stl(const char* file_name) {
    constexpr std::streamoff header_size =
        vcg::tri::io::ImporterSTL<UnrepairedMesh>::STL_LABEL_SIZE;
    std::ifstream file(file_name, std::ios::binary | std::ios::ate);
    const std::streamoff size = file.tellg();
    std::uint32_t count = 0;
    file.seekg(header_size);
    file.read(reinterpret_cast<char*>(&count), sizeof count);
    return file && size == header_size + 4 + std::streamoff{50} * count;
}

}  // namespace tracked_mcf

// The names are vcglib's.
// NOLINTBEGIN(readability-identifier-naming)

namespace vcg::tri::io {

/// vcglib 2020.09 takes 0 for an index that is wrong, though the reader has already made indices
/// count from 0: every face that uses the first vertex of the file would be lost.
template <>
inline bool ImporterOBJ<tracked_mcf::VcglibMesh>::GoodObjIndex(int& index, const int count) {
    if (index < 0) index += count + 1;
    return index >= 0 && index < count;
}

/// vcglib replaces the materials of one library by those of the next, and keeps none where one is
/// damaged, while faces go on referring to them.
template <>
inline bool ImporterOBJ<tracked_mcf::VcglibMesh>::LoadMaterials(
    const char* file_name, std::vector<Material>& materials, std::vector<std::string>& textures) {
    std::vector<Material> loaded;
    const std::string path = (tracked_mcf::VcglibMesh::material_folder / file_name).string();
    const bool complete =
        ImporterOBJ<tracked_mcf::UnrepairedMesh>::LoadMaterials(path.c_str(), loaded, textures);
    materials.insert(materials.end(), loaded.begin(), loaded.end());
    return complete;
}

/// vcglib takes the 80 bytes of the header for a text that ends with a zero, which need not be
/// there, and leaves the file open.
template <>
inline bool ImporterSTL<tracked_mcf::VcglibMesh>::IsSTLColored(const char* file_name, bool& colored,
                                                               bool& magics) {
    colored = magics = false;
    if (!tracked_mcf::is_binary_stl(file_name)) return true;
    std::ifstream file(file_name, std::ios::binary);
    std::string header(STL_LABEL_SIZE + sizeof(std::uint32_t), '\0');
    if (!file.read(header.data(), static_cast<std::streamsize>(header.size()))) return true;
    header.resize(STL_LABEL_SIZE);
    magics = header.find("COLOR=") != header.npos && header.find("MATERIAL=") != header.npos;
    // Each triangle ends with 15 bits of colour, and one that says that they are not just padding.
    for (std::array<char, 50> triangle; !colored && file.read(triangle.data(), triangle.size());) {
        colored = triangle[48] != 0 || triangle[49] != 0;
    }
    return true;
}

}  // namespace vcg::tri::io

// NOLINTEND(readability-identifier-naming)
