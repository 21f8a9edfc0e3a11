#include "filter_tracked_mcf/tool/vcglib_reading.h"

#include <wrap/io_trimesh/import_off.h>

#include "filter_tracked_mcf/tool/documents/stl_check.h"
#include "filter_tracked_mcf/tool/file_error.h"
#include "filter_tracked_mcf/tool/ply_to_vcglib.h"
#include "filter_tracked_mcf/tool/vcglib_repairs.h"

namespace tracked_mcf {

namespace fs = std::filesystem;
namespace io = vcg::tri::io;
using io::Mask;

namespace {

using ObjReader = io::ImporterOBJ<VcglibMesh>;
using StlReader = io::ImporterSTL<VcglibMesh>;

/// Throws what vcglib says of a file that it cannot read, if it says so.
void check_read(bool failed, const fs::path& path, const char* message) {
    if (!failed) return;
    throw UnreadableFile(path.string() + " cannot be read: " + message +
                         ". Repair the file or export the mesh again.");
}

int read_obj(VcglibMesh& mesh, const fs::path& path) {
    VcglibMesh::material_folder = path.parent_path();
    ObjReader::Info info;
    ObjReader::LoadMask(path.c_str(), info);
    // vcglib drops faces where normals are not given for all corners, and ours are made anew.
    info.mask &= ~(Mask::IOM_VERTNORMAL | Mask::IOM_WEDGNORMAL);
    info.mask |= Mask::IOM_VERTCOORD | Mask::IOM_FACEINDEX;
    const int error = ObjReader::Open(mesh, path.c_str(), info);
    check_read(ObjReader::ErrorCritical(error), path, ObjReader::ErrorMsg(error));
    return info.mask;
}

int read_off(VcglibMesh& mesh, const fs::path& path) {
    int mask = 0;
    const int error = io::ImporterOFF<VcglibMesh>::Open(mesh, path.c_str(), mask);
    check_read(error != 0, path, io::ImporterOFF<VcglibMesh>::ErrorMsg(error));
    // vcglib skips texture coordinates, while its mask says that they are there.
    return mask & ~Mask::IOM_VERTTEXCOORD;
}

int read_stl(VcglibMesh& mesh, const fs::path& path) {
    check_stl(path);
    int mask = 0;
    StlReader::LoadMask(path.c_str(), mask);
    const int error = is_binary_stl(path.c_str()) ? StlReader::OpenBinary(mesh, path.c_str(), mask)
                                                  : StlReader::OpenAscii(mesh, path.c_str());
    check_read(error != 0, path, StlReader::ErrorMsg(error));
    return mask;
}

/// Faces that name a vertex twice are left out by vcglib's OBJ reader; they have no area, but they
/// are part of the mesh.
void add_faces_left_out(const Polygons& polygons, VcglibMesh& mesh) {
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        const auto vertex = [&](std::size_t corner) {
            return static_cast<std::size_t>(polygons.corners[polygons.first[i] + corner]);
        };
        for (std::size_t k = 1; k + 1 < polygons.corner_count(i); ++k) {
            const std::size_t a = vertex(0), b = vertex(k), c = vertex(k + 1);
            if (a != b && b != c && c != a) continue;
            auto face = vcg::tri::Allocator<VcglibMesh>::AddFace(mesh, a, b, c);
            face->C() = vcg::Color4b(vcg::Color4b::LightGray);
            for (int j = 0; j < 3; ++j) face->WT(j) = {0, 0};
        }
    }
}

/// Sets right what files can make of a mesh that would lead vcglib's writers astray.
void sanitize(VcglibMesh& mesh, int mask) {
    for (auto& vertex : mesh.vert) vertex.ClearD();
    for (auto& face : mesh.face) face.ClearD();
    mesh.vn = static_cast<int>(mesh.vert.size());
    mesh.fn = static_cast<int>(mesh.face.size());
    // Written to OBJ whether asked for or not, and read without a look at their indices.
    mesh.edge.clear();
    mesh.en = 0;
    const auto texture_count = static_cast<int>(mesh.textures.size());
    for (auto& face : mesh.face) {
        for (int corner = 0; corner < 3; ++corner) {
            auto& coordinate = face.WT(corner);
            const bool known = (mask & Mask::IOM_WEDGTEXCOORD) && coordinate.n() >= 0 &&
                               coordinate.n() < texture_count;
            if (!known) coordinate.n() = static_cast<short>(texture_count > 0 ? 0 : -1);
        }
    }
}

int read_mesh(const fs::path& path, const MeshDocument* document, VcglibMesh& mesh) {
    if (!document) return read_stl(mesh, path);
    if (const auto* const ply = dynamic_cast<const PlyDocument*>(document)) {
        return ply_to_vcglib(*ply, mesh);
    }
    if (lower_case_extension(path) == ".off") return read_off(mesh, path);
    const int mask = read_obj(mesh, path);
    add_faces_left_out(document->polygons(), mesh);
    return mask;
}

}  // namespace

int read_with_vcglib(const fs::path& path, const MeshDocument* document, VcglibMesh& mesh) {
    int mask = read_mesh(path, document, mesh);
    sanitize(mesh, mask);
    if (!document) return mask;
    if (document->has_normals()) mask |= Mask::IOM_VERTNORMAL;
    if (mesh.vert.size() == document->positions().size()) return mask;
    throw UnreadableFile(path.string() + " cannot be read: it has " +
                         std::to_string(document->positions().size()) +
                         " vertices, of which vcglib finds " + std::to_string(mesh.vert.size()) +
                         ". Export the mesh again.");
}

}  // namespace tracked_mcf
