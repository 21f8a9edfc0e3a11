// SPDX-License-Identifier: GPL-3.0-or-later
/// STL: triangles with three vertices of their own each, in floats.

#include <gtest/gtest.h>

#include "filter_tracked_mcf/hosts/cli/mesh_file.h"
#include "tests/cli/temporary_folder.h"

namespace tracked_mcf {
namespace {

std::string triangle_bytes(float nx, float ny, float nz, float width, std::uint16_t color) {
    return packed(nx, ny, nz, 0.f, 0.f, 0.f, width, 0.f, 0.f, 0.f, 1.f, 0.f, color);
}

TEST(Stl, TrianglesColoursAndOrderAreKept) {
    const TemporaryFolder folder;
    const std::string name = "some scanner" + std::string(68, ' ');
    const std::string header = name + packed(2u);
    // Red and blue in five bits each; the first bit says that there is a colour.
    const std::uint16_t red = 0x8000 | 31, blue = 0x8000 | (31 << 10);
    write_file(folder / "in.stl",
               header + triangle_bytes(9, 9, 9, 1, red) + triangle_bytes(9, 9, 9, 4, blue));
    MeshFile file(folder / "in.stl");
    TriangleMesh mesh = file.triangle_mesh();
    ASSERT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}}));
    for (auto& p : mesh.positions) p.x() *= 2;
    EXPECT_EQ(written(file, mesh, "out.stl"),
              header + triangle_bytes(0, 0, 1, 2, red) + triangle_bytes(0, 0, 1, 8, blue));
}

}  // namespace
}  // namespace tracked_mcf
