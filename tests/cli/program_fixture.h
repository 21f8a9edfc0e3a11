// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/hosts/cli/mesh_file.h"
#include "tests/cli/temporary_folder.h"
#include "tests/support/measures.h"

namespace tracked_mcf {

inline const std::string kTetrahedron =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

/// A flat square of n by n vertices.
inline std::string grid(int n) {
    std::ostringstream off;
    off << "OFF\n" << n * n << ' ' << (n - 1) * (n - 1) << " 0\n";
    for (int i = 0; i < n * n; ++i) off << i % n << ' ' << i / n << " 0\n";
    for (int i = 0; i < n * (n - 1); ++i) {
        if (i % n == n - 1) continue;
        off << "4 " << i << ' ' << i + 1 << ' ' << i + n + 1 << ' ' << i + n << '\n';
    }
    return off.str();
}

/// A folder with the tetrahedron as a.off, for runs of the program.
class ProgramFixture : public ::testing::Test {
protected:
    void SetUp() override { write_file(folder_ / "a.off", kTetrahedron); }

    ProgramRun run(const std::string& arguments) const { return run_program(folder_, arguments); }

    /// Returns the area of the surface in a file.
    double area(const std::string& name) const {
        return surface_area(MeshFile(folder_ / name).triangle_mesh());
    }

    TemporaryFolder folder_;
};

}  // namespace tracked_mcf
