// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace tracked_mcf {

/// Writes files that stand for those of a system, below a folder of the test.
class SystemFiles : public ::testing::Test {
protected:
    void SetUp() override { std::filesystem::remove_all(root_); }
    void TearDown() override { std::filesystem::remove_all(root_); }

    void write(const std::string& path, const std::string& content) const {
        const std::filesystem::path file = root_ + path;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file) << content;
    }

    const std::string root_ =
        ::testing::TempDir() + "tracked_mcf_system_files_" + std::to_string(getpid());
};

}  // namespace tracked_mcf
