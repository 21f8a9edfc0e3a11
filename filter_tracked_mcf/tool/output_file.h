// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace tracked_mcf {

/// An output file that appears complete or not at all. It is written in a hidden temporary folder
/// beside its final path, and commit() moves it there. Until then, and if anything fails, an old
/// file stays as it was.
class OutputFile {
public:
    /// Throws UnwritableFile if `path` cannot be written. Creates no file.
    explicit OutputFile(const std::filesystem::path& path);

    /// Removes the temporary folder and everything that was not committed.
    ~OutputFile();

    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Returns the path to write to: the file's name in the temporary folder, which this call
    /// creates. The folder may get other files as well. Throws UnwritableFile.
    std::filesystem::path stage();

    /// Writes a whole text to that path. Throws UnwritableFile.
    void stage_text(const std::string& text);

    /// Returns the folder of the final path.
    std::filesystem::path folder() const { return path_.parent_path(); }

    /// Moves everything in the temporary folder to the final folder. Throws UnwritableFile.
    void commit();

private:
    std::filesystem::path path_;
    std::filesystem::path temporary_;  ///< folder; empty while there is none
};

}  // namespace tracked_mcf
