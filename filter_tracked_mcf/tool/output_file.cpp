// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/tool/output_file.h"

#include <stdlib.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include "filter_tracked_mcf/tool/file_error.h"

namespace tracked_mcf {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
    throw UnwritableFile("cannot write " + path.string() + ": " + why + ".");
}

/// Creates a new folder in `parent`; a failure is reported for `for_file`.
fs::path make_temporary_folder(const fs::path& parent, const fs::path& for_file) {
    std::string name = (parent / ".tracked_mcf-XXXXXX").string();
    if (!mkdtemp(name.data())) {
        fail(for_file, std::string(std::strerror(errno)) + " in folder " + parent.string());
    }
    return name;
}

}  // namespace

OutputFile::OutputFile(const fs::path& path) {
    std::error_code error;
    // Symbolic links are resolved: commit() replaces the file and not the link.
    path_ = fs::weakly_canonical(fs::absolute(path), error);
    if (error) fail(path, error.message());
    const fs::file_status status = fs::status(path_, error);
    if (fs::is_directory(status)) fail(path, "it is a folder; add a file name");
    if (fs::exists(status)) {
        if (!fs::is_regular_file(status)) fail(path, "it is not a regular file");
        if (access(path_.c_str(), W_OK) != 0) fail(path, std::strerror(errno));
    }
    if (!fs::is_directory(folder(), error)) {
        fail(path, "there is no folder " + folder().string() + "; create it first");
    }
    fs::remove(make_temporary_folder(folder(), path), error);
}

OutputFile::~OutputFile() {
    std::error_code ignored;
    if (!temporary_.empty()) fs::remove_all(temporary_, ignored);
}

fs::path OutputFile::stage() {
    if (temporary_.empty()) temporary_ = make_temporary_folder(folder(), path_);
    return temporary_ / path_.filename();
}

void OutputFile::stage_text(const std::string& text) {
    errno = 0;
    std::ofstream out(stage(), std::ios::binary);
    out << text;
    out.close();
    if (!out) fail(path_, errno != 0 ? std::strerror(errno) : "the disk may be full");
}

void OutputFile::commit() {
    std::error_code error;
    for (const fs::directory_entry& staged : fs::directory_iterator(temporary_)) {
        fs::rename(staged.path(), folder() / staged.path().filename(), error);
        if (error) fail(path_, error.message());
    }
}

}  // namespace tracked_mcf
