// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <set>

namespace tracked_mcf {

/// Returns the name of a step's file: smooth_0010.ply for step 10 of smooth.ply.
std::filesystem::path step_path(const std::filesystem::path& output, int step);

/// The files of --every. Each appears complete or not at all, see OutputFile.
class StepFiles {
public:
    /// Files of every `every` steps; 0 writes none.
    StepFiles(std::filesystem::path output, int every);

    /// Returns whether `path` is the name of a file that may be written.
    bool includes(const std::filesystem::path& path) const;

    /// Writes or replaces the file of this step if `every` divides its number. Throws
    /// UnwritableFile.
    void write(int step, const std::function<void(std::ostream&)>& write_content);

    /// Removes the files of steps after this one, which a flow has taken back.
    void remove_after(int last_step);

private:
    std::filesystem::path output_;
    int every_;
    std::set<int> written_;
};

}  // namespace tracked_mcf
