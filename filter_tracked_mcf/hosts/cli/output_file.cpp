// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/output_file.h"

#include <cerrno>
#include <cstring>
#include <random>
#include <string>

#include "filter_tracked_mcf/hosts/cli/file_error.h"

namespace tracked_mcf {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
    throw UnwritableFile("cannot write " + path.u8string() + ": " + why + ".");
}

/// Returns the reason of the latest failure of a stream, if errno was 0 before.
std::string reason_of_stream() {
    return errno != 0 ? std::strerror(errno) : "the disk may be full";
}

}  // namespace

fs::path follow_links(const fs::path& path, std::error_code& error) {
    fs::path target = fs::absolute(path, error);
    // weakly_canonical() does not follow a link that leads to no file. Linux follows 40 links.
    for (int link = 0; link < 40 && fs::is_symlink(fs::symlink_status(target, error)); ++link) {
        target = target.parent_path() / fs::read_symlink(target, error);
    }
    const fs::path canonical = fs::weakly_canonical(target, error);
    return error ? target : canonical;
}

OutputFile::TemporaryFile::TemporaryFile(const fs::path& target) {
    std::random_device random;
    std::error_code ignored;
    do {
        path = target.parent_path() / (".tracked_mcf-" + std::to_string(random()));
    } while (fs::exists(path, ignored));
    errno = 0;
    stream.open(path, std::ios::binary);
    if (!stream) fail(target, reason_of_stream() + " in folder " + path.parent_path().u8string());
}

OutputFile::TemporaryFile::~TemporaryFile() {
    stream.close();  // or else Windows cannot remove it
    std::error_code ignored;
    fs::remove(path, ignored);
}

OutputFile::OutputFile(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::is_directory(status)) fail(path, "it is a folder; add a file name");
    if (fs::is_fifo(status)) {
        path_ = path;
        is_pipe_ = true;
        return;  // opening it would wait for a reader
    }
    if (fs::exists(status)) {
        if (!fs::is_regular_file(status)) fail(path, "it is neither a regular file nor a pipe");
        errno = 0;
        if (!std::ofstream(path, std::ios::app)) fail(path, reason_of_stream());
    }
    path_ = follow_links(path, error);
    if (error) fail(path, error.message());
    if (!fs::is_directory(path_.parent_path(), error)) {
        fail(path, "there is no folder " + path_.parent_path().u8string() + "; create it first");
    }
    // Finds out whether files can be created there.
    const TemporaryFile probe(path_);
}

void OutputFile::write(const std::function<void(std::ostream&)>& write_content) {
    if (is_pipe_) {
        errno = 0;
        std::ofstream pipe(path_, std::ios::binary);
        write_content(pipe);
        pipe.close();
        if (!pipe) fail(path_, reason_of_stream());
        return;
    }
    TemporaryFile& file = temporary_.emplace(path_);
    std::error_code ignored;
    const fs::file_status old = fs::status(path_, ignored);
    // Before the content, which others may not be allowed to read. Special bits such as set-user-ID
    // belong to the old owner.
    if (fs::exists(old)) fs::permissions(file.path, old.permissions() & fs::perms::all, ignored);
    errno = 0;
    write_content(file.stream);
    file.stream.close();
    if (!file.stream) fail(path_, reason_of_stream());
}

void OutputFile::commit() {
    if (is_pipe_) return;
    std::error_code error;
    fs::rename(temporary_->path, path_, error);
    if (error) fail(path_, error.message());
    temporary_.reset();
}

}  // namespace tracked_mcf
