// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

class FileDocument;

/// A mesh that was read from a PLY, OBJ, OFF or STL file.
///
/// Written in its own format, the file keeps everything but positions and normals to the letter,
/// as text or binary. Another format, PLY or STL, gets the positions and the polygons. STL has
/// triangles, in floats.
class MeshFile {
public:
    /// Reads a file in the format of its extension. Throws UnreadableFile.
    explicit MeshFile(const std::filesystem::path& path);

    /// Returns the vertices and the triangles of the faces, in the order of the file.
    TriangleMesh triangle_mesh() const;

    /// Returns whether another file has as many vertices and faces; triangles, if one of the two is
    /// an STL file, which has the vertices of each.
    bool is_as_large_as(const MeshFile& other) const;
    /// Returns the numbers of vertices and faces, for messages.
    std::string size() const;

    /// Returns which of these triangles the property `name` selects: a number of the
    /// faces, or else of the vertices. A face is selected if its number is not zero, or if the
    /// numbers of all its vertices are not. In `flags`, where MeshLab keeps a selection, only the
    /// bit for selected counts.
    ///
    /// Throws InvalidParameter if there is no such property, and InvalidMesh if it selects nothing.
    Selection selection_by(const std::string& name) const;

    /// Returns the number `name` of each vertex. Throws InvalidParameter if there is none.
    std::vector<double> numbers_by(const std::string& name) const;

    /// Gives each vertex a number, which write() writes to a PLY file as the property `quality`.
    void set_quality(const std::vector<double>& quality);

    /// Makes write() write coordinates and normals as doubles where the format has them. Otherwise
    /// a PLY file keeps its types.
    void write_doubles();

    /// Returns whether write() rounds coordinates to floats.
    bool writes_floats(const std::filesystem::path& file) const;

    /// Writes the mesh with the positions of `moved`, which triangle_mesh() made, in the format of
    /// the extension of `file`: the mesh's own format, or PLY or STL, which are binary then.
    void write(const TriangleMesh& moved, std::ostream& out,
               const std::filesystem::path& file) const;

    /// Tells the user what write() leaves out of `file`, and how to keep it; empty if nothing.
    std::string conversion_warning(const std::filesystem::path& file) const;

private:
    std::filesystem::path path_;
    std::shared_ptr<FileDocument> document_;
};

}  // namespace tracked_mcf
