// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <string>
#include <utility>

namespace tracked_mcf {

/// Sets an environment variable, and restores it at the end of a test.
class EnvironmentVariable {
public:
    explicit EnvironmentVariable(std::string name) : name_(std::move(name)) {
        if (const char* const value = std::getenv(name_.c_str())) before_ = value;
    }
    ~EnvironmentVariable() { set(before_); }
    EnvironmentVariable(const EnvironmentVariable&) = delete;
    EnvironmentVariable& operator=(const EnvironmentVariable&) = delete;

    /// An empty value is as good as none.
    void set(const std::string& value) const {
#ifdef _WIN32
        _putenv_s(name_.c_str(), value.c_str());
#else
        setenv(name_.c_str(), value.c_str(), 1);
#endif
    }

private:
    const std::string name_;
    std::string before_;
};

}  // namespace tracked_mcf
