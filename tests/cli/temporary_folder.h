// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "filter_tracked_mcf/hosts/cli/mesh_file.h"
#include "filter_tracked_mcf/hosts/cli/output_file.h"

namespace tracked_mcf {

/// A folder for the files of one test. The destructor removes it with all files.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();

    /// Returns the path of the file `name` in the folder. The name is UTF-8.
    std::filesystem::path operator/(const std::string& name) const {
        return path_ / std::filesystem::u8path(name);
    }

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

std::string read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, const std::string& content);

/// Returns the bytes of `file` with the positions of `mesh`, in the format of the extension of
/// `name`.
std::string written(const MeshFile& file, const TriangleMesh& mesh, const std::string& name);

/// Returns what is written for a file with this content and extension if every x is doubled.
std::string written_with_x_doubled(const std::string& content, const std::string& extension);

/// Writes `text`, and does not commit it.
void write_text(OutputFile& output, const std::string& text);
/// Writes a text to a file, and commits it.
void commit(const std::filesystem::path& path, const std::string& text);
/// Returns the words of a text.
std::vector<std::string> words_of(const std::string& text);

/// The results of a run of the program tracked_mcf.
struct ProgramRun {
    int exit_code;
    std::string output, errors;
};

/// Runs the program in `folder` with `arguments`, which a shell splits. `before` is put before the
/// call: commands such as "ulimit -f 1;" or variables such as "LC_ALL=de_DE.UTF-8".
ProgramRun run_program(const TemporaryFolder& folder, const std::string& arguments,
                       const std::string& before = "");

/// Returns the bytes of a number in this machine's order.
template <class Number>
std::string bytes_of(Number number) {
    return {reinterpret_cast<const char*>(&number), sizeof number};
}

template <class... Numbers>
std::string packed(Numbers... numbers) {
    return (bytes_of(numbers) + ...);
}

}  // namespace tracked_mcf
