#include "filter_tracked_mcf/tool/vcglib_writing.h"

#include <wrap/io_trimesh/export_obj.h>
#include <wrap/io_trimesh/export_off.h>
#include <wrap/io_trimesh/export_ply.h>
#include <wrap/io_trimesh/export_stl.h>

#include "filter_tracked_mcf/tool/documents/mesh_document.h"

namespace tracked_mcf {

namespace io = vcg::tri::io;
using io::Mask;

bool write_with_vcglib(VcglibMesh& mesh, int mask, const std::filesystem::path& file) {
    const std::string extension = lower_case_extension(file);
    const char* const name = file.c_str();
    if (extension == ".stl") {
        return io::ExporterSTL<VcglibMesh>::Save(mesh, name, true, mask) == 0;
    }
    if (extension == ".obj") {
        mask &= io::ExporterOBJ<VcglibMesh>::GetExportMaskCapability();
        return io::ExporterOBJ<VcglibMesh>::Save(mesh, name, mask) == 0;
    }
    if (extension == ".off") {
        // vcglib would write a polygon's flags for its vertices, and normals where colours go.
        mask &= io::ExporterOFF<VcglibMesh>::GetExportMaskCapability() & ~Mask::IOM_BITPOLYGONAL;
        return io::ExporterOFF<VcglibMesh>::Save(mesh, name, mask) == 0;
    }
    // vcglib announces texture coordinates of vertices as floats and writes doubles. An OBJ, where
    // these can come from, has those of the corners as well.
    mask &= ~Mask::IOM_VERTTEXCOORD;
    return io::ExporterPLY<VcglibMesh>::Save(mesh, name, mask, true) == 0;
}

}  // namespace tracked_mcf
