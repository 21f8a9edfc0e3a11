// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/cli/step_files.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <system_error>
#include <utility>

#include "filter_tracked_mcf/hosts/cli/output_file.h"

namespace tracked_mcf {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kDigits = 4;

}  // namespace

fs::path step_path(const fs::path& output, int step) {
    const std::string number = std::to_string(step);
    fs::path name = output.stem();
    name += "_" + std::string(kDigits - std::min(kDigits, number.size()), '0') + number;
    name += output.extension();
    return output.parent_path() / name;
}

StepFiles::StepFiles(fs::path output, int every) : output_(std::move(output)), every_(every) {}

bool StepFiles::includes(const fs::path& path) const {
    if (every_ == 0) return false;
    const std::string stem = path.stem().u8string();
    const auto number = std::find(stem.rbegin(), stem.rend(), '_').base();
    int step = 0;  // also if there is no number after the last underscore
    std::from_chars(stem.data() + (number - stem.begin()), stem.data() + stem.size(), step);
    if (step <= 0 || step % every_ != 0) return false;
    std::error_code ignored;
    return follow_links(path, ignored) == follow_links(step_path(output_, step), ignored);
}

void StepFiles::write(int step, const std::function<void(std::ostream&)>& write_content) {
    if (every_ == 0 || step % every_ != 0) return;
    OutputFile file(step_path(output_, step));
    file.write(write_content);
    file.commit();
    written_.insert(step);
}

void StepFiles::remove_after(int last_step) {
    for (auto step = written_.upper_bound(last_step); step != written_.end(); ++step) {
        std::error_code ignored;
        fs::remove(step_path(output_, *step), ignored);
    }
}

}  // namespace tracked_mcf
