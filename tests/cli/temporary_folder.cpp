// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/cli/temporary_folder.h"

#ifndef _WIN32
#include <sys/wait.h>
#endif

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>
#include <stdexcept>

namespace tracked_mcf {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
    std::random_device random;
    do {
        path_ = fs::temp_directory_path() / ("tracked_mcf_test_" + std::to_string(random()));
    } while (!fs::create_directory(path_));
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

std::string read_file(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("cannot read " + path.string());
    std::ostringstream content;
    content << file.rdbuf();
    return content.str();
}

void write_file(const fs::path& path, const std::string& content) {
    std::ofstream file(path, std::ios::binary);
    file << content;
    file.close();
    if (!file) throw std::runtime_error("cannot write " + path.string());
}

std::string written(const MeshFile& file, const TriangleMesh& mesh, const std::string& name) {
    std::ostringstream out;
    file.write(mesh, out, name);
    return out.str();
}

std::string written_with_x_doubled(const std::string& content, const std::string& extension) {
    const TemporaryFolder folder;
    write_file(folder / ("in." + extension), content);
    MeshFile file(folder / ("in." + extension));
    TriangleMesh mesh = file.triangle_mesh();
    for (auto& p : mesh.positions) p.x() *= 2;
    return written(file, mesh, "out." + extension);
}

void write_text(OutputFile& output, const std::string& text) {
    output.write([&](std::ostream& out) { out << text; });
}

void commit(const fs::path& path, const std::string& text) {
    OutputFile output(path);
    write_text(output, text);
    output.commit();
}

std::vector<std::string> words_of(const std::string& text) {
    std::istringstream stream(text);
    return {std::istream_iterator<std::string>(stream), {}};
}

namespace {

/// Lets the system's shell run a command. Returns its exit code, or -1 if a signal ended it.
int exit_code_of(const std::string& command) {
#ifdef _WIN32
    return _wsystem(fs::u8path(command).c_str());
#else
    // NOLINTNEXTLINE(bugprone-command-processor): tests redirect streams and set limits in a shell
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
#endif
}

/// Returns what a program has printed. On Windows, lines of printed text end with "\r\n".
std::string read_printed(const fs::path& path) {
    std::string text = read_file(path);
#ifdef _WIN32
    text.erase(std::remove(text.begin(), text.end(), '\r'), text.end());
#endif
    return text;
}

}  // namespace

ProgramRun run_program(const TemporaryFolder& folder, const std::string& arguments,
                       const std::string& before) {
    const TemporaryFolder streams;
    const std::string to_streams =
        " >" + (streams / "output").string() + " 2>" + (streams / "errors").string();
#ifdef _WIN32
    const std::string command = "cd /d " + folder.path().string() + " && " + before +
                                " " TRACKED_MCF_PROGRAM " " + arguments + to_streams;
#else
    const std::string command = "cd " + folder.path().string() + " && (" + before +
                                " " TRACKED_MCF_PROGRAM " " + arguments + ")" + to_streams;
#endif
    const int exit_code = exit_code_of(command);
    return {exit_code, read_printed(streams / "output"), read_printed(streams / "errors")};
}

}  // namespace tracked_mcf
