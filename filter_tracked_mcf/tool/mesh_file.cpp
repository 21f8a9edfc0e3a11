#include "filter_tracked_mcf/tool/mesh_file.h"

#include <fstream>
#include <new>

#include "filter_tracked_mcf/mesh_bridge/mesh_bridge.h"
#include "filter_tracked_mcf/tool/documents/mesh_document.h"
#include "filter_tracked_mcf/tool/face_selection.h"
#include "filter_tracked_mcf/tool/file_error.h"
#include "filter_tracked_mcf/tool/vcglib_reading.h"
#include "filter_tracked_mcf/tool/vcglib_writing.h"

namespace tracked_mcf {

namespace fs = std::filesystem;

namespace {

class WritingFailed : public std::exception {};

void check_written(bool success) {
    if (!success) throw WritingFailed();
}

void write_document(const MeshDocument& document, const Points& positions, const fs::path& file,
                    const FolderChange& change) {
    std::ofstream out(file, std::ios::binary);
    document.write(out, positions, change);
    out.close();
    check_written(!out.fail());
}

std::unique_ptr<MeshDocument> document_of(const fs::path& path) {
    // An STL has nothing that vcglib does not know of.
    return lower_case_extension(path) == ".stl" ? nullptr : open_document(path);
}

}  // namespace

class MeshFile::Content {
public:
    explicit Content(const fs::path& path)
        : path_(path),
          folder_(fs::absolute(path).parent_path()),
          extension_(lower_case_extension(path)),
          document_(document_of(path)),
          mask_(read_with_vcglib(path, document_.get(), mesh_)) {}

    TriangleMesh triangle_mesh() const { return to_triangle_mesh(mesh_); }

    Selection selection_by(const std::string& name) const {
        if (const auto* const ply = dynamic_cast<const PlyDocument*>(document_.get())) {
            return selected_triangles(*ply, name, path_.string());
        }
        throw InvalidParameter("--selected needs a PLY file, and " + path_.string() +
                               " is none; only PLY has properties to select by.");
    }

    void write(const TriangleMesh& moved, const fs::path& file, const fs::path& final_folder) {
        const FolderChange change{folder_, final_folder};
        if (document_ && lower_case_extension(file) == extension_) {
            write_document(*document_, moved.positions, file, change);
        } else {
            convert(moved, file, change);
        }
    }

private:
    void convert(const TriangleMesh& moved, const fs::path& file, const FolderChange& change) {
        write_positions(moved, mesh_);
        const std::vector<std::string> textures = mesh_.textures;
        for (std::string& name : mesh_.textures) name = change.relocate(name);
        check_written(write_with_vcglib(mesh_, mask_, file));
        mesh_.textures = textures;
        check_and_refine(moved, file);
    }

    /// Whether what vcglib wrote is complete, which it does not notice; then with all digits, which
    /// it does not write.
    static void check_and_refine(const TriangleMesh& moved, const fs::path& file) {
        const auto written = document_of(file);
        if (written) {
            write_document(*written, moved.positions, file, {});
        } else {
            check_written(fs::file_size(file) == 84 + 50 * moved.triangles.size());
        }
    }

    fs::path path_, folder_;
    std::string extension_;
    std::unique_ptr<MeshDocument> document_;  ///< null for STL
    VcglibMesh mesh_;
    int mask_;  ///< vcglib's, of what the mesh has
};

MeshFile::MeshFile(const fs::path& path) : content_(std::make_unique<Content>(path)) {}

MeshFile::~MeshFile() = default;

TriangleMesh MeshFile::triangle_mesh() const {
    return content_->triangle_mesh();
}

Selection MeshFile::selection_by(const std::string& name) const {
    return content_->selection_by(name);
}

void MeshFile::write(const TriangleMesh& moved, const fs::path& file,
                     const fs::path& final_folder) {
    try {
        content_->write(moved, file, final_folder);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception&) {
        throw UnwritableFile("cannot write " + (final_folder / file.filename()).string() +
                             ": the disk may be full.");
    }
}

bool MeshFile::knows_format_of(const fs::path& path) {
    const std::string extension = lower_case_extension(path);
    return extension == ".ply" || extension == ".obj" || extension == ".off" || extension == ".stl";
}

}  // namespace tracked_mcf
