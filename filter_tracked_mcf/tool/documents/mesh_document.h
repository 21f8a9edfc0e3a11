#pragma once

#include <filesystem>
#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>

#include "filter_tracked_mcf/tool/documents/polygons.h"

namespace tracked_mcf {

/// A file that moves to another folder, and with it the names of textures and material libraries
/// that it refers to, which are relative to where it lies.
struct FolderChange {
    std::filesystem::path from, to;

    /// The name by which the file `name` of folder `from` is found from folder `to`.
    std::string relocate(const std::string& name) const;
};

/// A mesh file kept whole, with everything that only its format knows of, so that it can be written
/// again with nothing changed but positions and what follows from them. It has been checked: every
/// number is one, every index is in range, and nothing is missing at its end.
class MeshDocument {
public:
    virtual ~MeshDocument() = default;

    /// The vertices, in the order of the file.
    virtual const Points& positions() const = 0;

    /// The faces, in the order of the file.
    virtual const Polygons& polygons() const = 0;

    /// Whether the file states normals.
    virtual bool has_normals() const = 0;

    /// The same file with other positions. Normals, where there are any, become those of the new
    /// shape; one that no face with an area defines stays. Textures and material libraries are
    /// named as they are found after `change`.
    virtual void write(std::ostream& out, const Points& positions,
                       const FolderChange& change) const = 0;
};

/// Reads a file by its extension: .ply, .obj or .off. Throws UnreadableFile.
std::unique_ptr<MeshDocument> open_document(const std::filesystem::path& path);

/// The formats, from a file's whole content; they throw UnreadableFile without the file's name.
std::unique_ptr<MeshDocument> parse_ply(std::string_view content);
std::unique_ptr<MeshDocument> parse_obj(std::string content);
std::unique_ptr<MeshDocument> parse_off(std::string content);

/// The content of a file. Throws UnreadableFile.
std::string read_whole_file(const std::filesystem::path& path);

/// ".ply" of "Scan.PLY".
std::string lower_case_extension(const std::filesystem::path& path);

}  // namespace tracked_mcf
