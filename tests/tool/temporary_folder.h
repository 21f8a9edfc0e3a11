#pragma once

#include <filesystem>
#include <string>

namespace tracked_mcf {

/// A folder for one test's files, removed with all of them in the end.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();

    /// The path of the file `name` in it.
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

std::string read_file(const std::filesystem::path& path);
void write_file(const std::filesystem::path& path, const std::string& content);

/// What a run of the program tracked_mcf left behind.
struct ProgramRun {
    int exit_code;
    std::string output, errors;
};

/// Runs it with `arguments`, as a shell would split them, in `folder`; after the shell's commands
/// `before`, such as "ulimit -f 1;", or with variables set, such as "LC_ALL=de_DE.UTF-8".
ProgramRun run_program(const TemporaryFolder& folder, const std::string& arguments,
                       const std::string& before = "");

/// The bytes of a number in this machine's order.
template <class Number>
std::string bytes_of(Number number) {
    return {reinterpret_cast<const char*>(&number), sizeof number};
}

template <class... Numbers>
std::string packed(Numbers... numbers) {
    return (bytes_of(numbers) + ...);
}

}  // namespace tracked_mcf
