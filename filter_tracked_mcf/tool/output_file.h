#pragma once

#include <filesystem>
#include <string>

namespace tracked_mcf {

/// A file that appears complete or not at all: it is written in a hidden temporary folder beside
/// its place and moved there in the end. What was there before stays until then, and for good when
/// anything fails.
class OutputFile {
public:
    /// Throws UnwritableFile if `path` could not be written; makes no file yet.
    explicit OutputFile(const std::filesystem::path& path);

    /// Removes what was not moved to its place.
    ~OutputFile();

    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Where to write now: the file's name in the temporary folder, which this makes. Other files
    /// that belong to it may be put there as well. Throws UnwritableFile.
    std::filesystem::path stage();

    /// Writes a whole text, there. Throws UnwritableFile.
    void stage_text(const std::string& text);

    /// The folder where the file will be.
    std::filesystem::path folder() const { return place_.parent_path(); }

    /// Moves everything in the temporary folder to its place. Throws UnwritableFile.
    void commit();

private:
    std::filesystem::path place_;
    std::filesystem::path temporary_;  ///< folder; empty while there is none
};

}  // namespace tracked_mcf
