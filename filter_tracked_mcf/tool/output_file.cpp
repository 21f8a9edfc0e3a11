// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/tool/output_file.h"

#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

#include "filter_tracked_mcf/tool/file_error.h"

namespace tracked_mcf {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const fs::path& path, const std::string& why) {
    throw UnwritableFile("cannot write " + path.string() + ": " + why + ".");
}

/// Returns the reason of the latest failure of a stream, if errno was 0 before.
std::string reason_of_stream() {
    return errno != 0 ? std::strerror(errno) : "the disk may be full";
}

/// Gives `staged` the owner and the mode of `old`. Returns false if the system forbids it, or if
/// `old` has several hard links.
bool can_replace(const fs::path& old, const fs::path& staged) {
    struct stat status {};
    return stat(old.c_str(), &status) == 0 && status.st_nlink == 1 &&
           // A change of the owner clears the mode's special bits, so the mode comes second.
           chown(staged.c_str(), status.st_uid, status.st_gid) == 0 &&
           chmod(staged.c_str(), status.st_mode & 07777) == 0;
}

/// Copies everything from byte `begin` on to the same bytes of another file. Returns false if that
/// fails.
bool copy_from(std::uintmax_t begin, std::istream& in, std::ostream& out) {
    in.clear();
    in.seekg(static_cast<std::streamoff>(begin));
    out.seekp(static_cast<std::streamoff>(begin));
    std::vector<char> part(1 << 16);
    while (in && out) {
        in.read(part.data(), static_cast<std::streamsize>(part.size()));
        out.write(part.data(), in.gcount());
    }
    out.flush();
    return in.eof() && out;
}

/// Gives `file` the content of `staged` in place.
void overwrite(const fs::path& file, const fs::path& staged) {
    std::error_code error;
    const auto old_size = fs::file_size(file, error), new_size = fs::file_size(staged, error);
    errno = 0;
    std::ifstream in(staged, std::ios::binary);
    std::fstream out(file, std::ios::in | std::ios::out | std::ios::binary);
    // The part beyond the old end comes first, because only this part needs space on the disk, on
    // file systems that do not copy on write. If it fails, the old content is still there.
    if (new_size > old_size && !copy_from(old_size, in, out)) {
        const std::string reason = reason_of_stream();
        out.close();  // or else its destructor would write once more
        fs::resize_file(file, old_size, error);
        fail(file, reason);
    }
    if (!copy_from(0, in, out)) fail(file, reason_of_stream());
    out.close();
    fs::resize_file(file, new_size, error);
    if (error) fail(file, error.message());
}

}  // namespace

fs::path follow_links(const fs::path& path, std::error_code& error) {
    fs::path target = fs::absolute(path, error);
    // weakly_canonical() does not follow a link that leads to no file. Linux follows 40 links.
    const auto is_dangling = [&] {
        return !fs::exists(target, error) && fs::is_symlink(fs::symlink_status(target, error));
    };
    for (int link = 0; link < 40 && is_dangling(); ++link) {
        target = target.parent_path() / fs::read_symlink(target, error);
    }
    const fs::path canonical = fs::weakly_canonical(target, error);
    return error ? target : canonical;
}

OutputFile::StagingFolder::StagingFolder(const fs::path& parent, const fs::path& for_file) {
    std::string name = (parent / ".tracked_mcf-XXXXXX").string();
    if (!mkdtemp(name.data())) {
        fail(for_file, std::string(std::strerror(errno)) + " in folder " + parent.string());
    }
    path_ = name;
}

OutputFile::StagingFolder::~StagingFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

OutputFile::OutputFile(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (fs::is_directory(status)) fail(path, "it is a folder; add a file name");
    if (fs::exists(status)) {
        if (!fs::is_regular_file(status)) fail(path, "it is not a regular file");
        if (access(path.c_str(), W_OK) != 0) fail(path, std::strerror(errno));
    }
    path_ = follow_links(path, error);
    if (error) fail(path, error.message());
    if (!fs::is_directory(folder(), error)) {
        fail(path, "there is no folder " + folder().string() + "; create it first");
    }
    // Finds out whether files can be created there.
    const StagingFolder probe(folder(), path);
}

fs::path OutputFile::stage() {
    if (!staging_) staging_.emplace(folder(), path_);
    return staging_->path() / path_.filename();
}

void OutputFile::stage_text(const std::string& text) {
    errno = 0;
    std::ofstream out(stage(), std::ios::binary);
    out << text;
    out.close();
    if (!out) fail(path_, reason_of_stream());
}

void OutputFile::commit() {
    const fs::path staged = stage();
    std::error_code error;
    // A renamed file is complete at every moment. But it is another file than the old one: hard
    // links would lead to the old one, and its owner would be this user. Where that would change
    // anything, the old file gets the new content.
    if (fs::exists(path_, error) && !can_replace(path_, staged)) {
        overwrite(path_, staged);
    } else {
        fs::rename(staged, path_, error);
        if (error) fail(path_, error.message());
    }
    staging_.reset();
}

}  // namespace tracked_mcf
