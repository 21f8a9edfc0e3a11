// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include "filter_tracked_mcf/tool/interrupts.h"

namespace tracked_mcf {

/// Returns the file that `path` leads to through symbolic links, even if it does not exist. If the
/// system cannot tell, sets `error`.
std::filesystem::path follow_links(const std::filesystem::path& path, std::error_code& error);

/// An output file that appears complete or not at all. It is written in a hidden temporary folder
/// beside its final path, and commit() moves it there. Until then, and if anything fails, an old
/// file stays as it was.
///
/// A new version of an old file has its mode, its owner and all of its hard links. Symbolic links
/// are followed, also those that lead to no file yet.
class OutputFile {
public:
    /// Throws UnwritableFile if `path` cannot be written. Creates no file.
    explicit OutputFile(const std::filesystem::path& path);

    /// Returns the path to write to: the file's name in the temporary folder, which this call
    /// creates. Throws UnwritableFile. The destructor removes what was not committed.
    std::filesystem::path stage();

    /// Writes a whole text to that path. Throws UnwritableFile.
    void stage_text(const std::string& text);

    /// Returns the folder of the final path.
    std::filesystem::path folder() const { return path_.parent_path(); }

    /// Makes the staged file the final one. Throws UnwritableFile.
    void commit();

private:
    /// A new folder beside the final file. No interrupt ends the program while it exists.
    class StagingFolder {
    public:
        /// A failure is reported for `for_file`.
        StagingFolder(const std::filesystem::path& parent, const std::filesystem::path& for_file);
        ~StagingFolder();
        StagingFolder(const StagingFolder&) = delete;
        StagingFolder& operator=(const StagingFolder&) = delete;

        const std::filesystem::path& path() const { return path_; }

    private:
        InterruptHold hold_;
        std::filesystem::path path_;
    };

    std::filesystem::path path_;
    std::optional<StagingFolder> staging_;
};

}  // namespace tracked_mcf
