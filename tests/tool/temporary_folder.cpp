// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/tool/temporary_folder.h"

#include <stdlib.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace tracked_mcf {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "tracked_mcf_test_XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
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

ProgramRun run_program(const TemporaryFolder& folder, const std::string& arguments,
                       const std::string& before) {
    const TemporaryFolder streams;
    const std::string command =
        "cd " + folder.path().string() + " && (" + before + " " TRACKED_MCF_PROGRAM " " +
        arguments + ") >" + (streams / "output").string() + " 2>" + (streams / "errors").string();
    // NOLINTNEXTLINE(bugprone-command-processor): tests redirect streams and set limits in a shell
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(streams / "output"),
            read_file(streams / "errors")};
}

}  // namespace tracked_mcf
