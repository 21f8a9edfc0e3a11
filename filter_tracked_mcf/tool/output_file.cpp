// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/tool/output_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <random>
#include <vector>

#include "filter_tracked_mcf/tool/file_error.h"
#include "filter_tracked_mcf/tool/system.h"

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
    std::random_device random;
    std::error_code error;
    do {
        path_ = parent / (".tracked_mcf-" + std::to_string(random()));
    } while (!fs::create_directory(path_, error) && !error);  // another program may have the name
    if (!error) fs::permissions(path_, fs::perms::owner_all, error);
    if (error) fail(for_file, error.message() + " in folder " + parent.u8string());
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
        errno = 0;
        if (!std::ofstream(path, std::ios::app)) fail(path, reason_of_stream());
    }
    path_ = follow_links(path, error);
    if (error) fail(path, error.message());
    if (!fs::is_directory(folder(), error)) {
        fail(path, "there is no folder " + folder().u8string() + "; create it first");
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
