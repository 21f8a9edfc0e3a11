// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <system_error>

#include "filter_tracked_mcf/hosts/cli/interrupts.h"

namespace tracked_mcf {

/// Returns the file that `path` leads to through symbolic links, even if it does not exist. If the
/// system cannot tell, sets `error`.
std::filesystem::path follow_links(const std::filesystem::path& path, std::error_code& error);

/// An output file that appears complete or not at all. It is written under a temporary name beside
/// its final path, and commit() renames it. Until then, and if anything fails, an old file stays as
/// it was. Only a crash of the system may leave an incomplete file: nothing waits for the disk.
///
/// A pipe is written as it is. A new version of an old file has its mode. Symbolic links are
/// followed, also those that lead to no file yet.
class OutputFile {
public:
    /// Throws UnwritableFile if `path` cannot be written. Leaves no file there.
    explicit OutputFile(const std::filesystem::path& path);

    /// Writes the temporary file, or the pipe. Throws UnwritableFile. The destructor removes what
    /// was not committed.
    void write(const std::function<void(std::ostream&)>& write_content);

    /// Makes the written file the final one. Throws UnwritableFile.
    void commit();

private:
    /// A new file beside `target`. No interrupt ends the program while it exists.
    struct TemporaryFile {
        explicit TemporaryFile(const std::filesystem::path& target);
        ~TemporaryFile();

        InterruptHold hold;
        std::filesystem::path path;
        std::ofstream stream;
    };

    std::filesystem::path path_;
    bool is_pipe_ = false;
    std::optional<TemporaryFile> temporary_;
};

}  // namespace tracked_mcf
