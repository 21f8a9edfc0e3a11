// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cfloat>
#include <filesystem>
#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/hosts/cli/documents/polygons.h"

namespace tracked_mcf {

/// A mesh file, kept whole so that it can be written again with new positions and nothing else
/// changed. It has been checked: every number but those of colours is a number, every index of a
/// vertex is in range, a polygon has three corners, and nothing is missing at the end.
class FileDocument {
public:
    FileDocument() = default;
    virtual ~FileDocument() = default;

    // Documents keep views into their text.
    FileDocument(const FileDocument&) = delete;
    FileDocument& operator=(const FileDocument&) = delete;

    /// The vertices, in the order of the file.
    const Points& positions() const { return positions_; }

    /// The faces, in the order of the file.
    const Polygons& polygons() const { return polygons_; }

    /// What may have properties: numbers under names, which only PLY files have.
    enum class NumbersOf { Vertices, Faces };
    /// Returns the property `name` of all vertices or faces; empty if the file does not have it.
    virtual std::vector<double> numbers(NumbersOf /*items*/, const std::string& /*name*/) const {
        return {};
    }
    /// Returns the names of the properties.
    virtual std::vector<std::string> property_names(NumbersOf /*items*/) const { return {}; }

    /// Gives each vertex a number, which only PLY keeps: the property `quality`.
    void set_quality(std::vector<double> quality) { quality_ = std::move(quality); }
    /// Returns what set_quality() was given.
    const std::vector<double>& quality() const { return quality_; }

    /// Makes write() write coordinates and normals as doubles. Otherwise a PLY file keeps its
    /// types.
    void write_doubles() { doubles_ = true; }

    /// Returns whether write() writes coordinates as floats.
    virtual bool writes_floats() const { return false; }

    /// Names what the file has besides positions and polygons: what other formats do not keep.
    virtual std::vector<std::string> extras() const = 0;

    /// Writes the file with other positions. The normals of faces with a moved vertex become those
    /// of the new shape, except where no face has an area.
    virtual void write(std::ostream& out, const Points& positions) const = 0;

protected:
    bool doubles() const { return doubles_; }

    /// Returns the relative precision of coordinates.
    double precision() const { return writes_floats() ? FLT_EPSILON : DBL_EPSILON; }

    Points positions_;
    Polygons polygons_;

private:
    std::vector<double> quality_;
    bool doubles_ = false;
};

/// A file format, known by the extension of its files.
struct Format {
    const char* extension;  ///< lower case, such as ".ply"

    /// Makes a document of a file's whole content, see parse_document().
    std::unique_ptr<FileDocument> (*parse)(std::string&& content);

    /// Writes `positions` with the polygons of `source`, which may have any format; null if only a
    /// file of this format can be written in it.
    void (*convert)(std::ostream& out, const FileDocument& source, const Points& positions);

    bool has_numbers;  ///< whether files may have numbers under names
};

/// Returns the format of a path by its extension, in upper or lower case; null if it is unknown.
const Format* format_of(const std::filesystem::path& path);

/// Makes a document of a file's whole content. Throws UnreadableFile without the file's name.
std::unique_ptr<FileDocument> parse_document(const Format& format, std::string&& content);

/// Reads a file in the format of its extension. Throws UnreadableFile.
std::unique_ptr<FileDocument> open_document(const std::filesystem::path& path);

/// The functions that format_of() lists in its formats.
std::unique_ptr<FileDocument> parse_ply(std::string&& content);
std::unique_ptr<FileDocument> parse_obj(std::string&& content);
std::unique_ptr<FileDocument> parse_off(std::string&& content);
std::unique_ptr<FileDocument> parse_stl(std::string&& content);
void convert_to_ply(std::ostream& out, const FileDocument& source, const Points& positions);
void convert_to_stl(std::ostream& out, const FileDocument& source, const Points& positions);

}  // namespace tracked_mcf
