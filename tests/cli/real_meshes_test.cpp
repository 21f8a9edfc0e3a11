// SPDX-License-Identifier: GPL-3.0-or-later
/// Meshes of other programs, if a folder of them exists, are read and written without a change.

#include <gtest/gtest.h>

#include <ostream>
#include <set>

#include "filter_tracked_mcf/hosts/cli/mesh_file.h"
#include "tests/cli/temporary_folder.h"

namespace tracked_mcf {
namespace {

struct RealMesh {
    const char* name;
    std::size_t vertices, triangles;
};

std::ostream& operator<<(std::ostream& out, const RealMesh& mesh) {
    return out << mesh.name;
}

class RealMeshes : public ::testing::TestWithParam<RealMesh> {};

TEST_P(RealMeshes, ComeBack) {
    const auto path = std::filesystem::path(TRACKED_MCF_SHARED_MESHES) / GetParam().name;
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
    const TemporaryFolder folder;
    MeshFile file(path);
    const TriangleMesh mesh = file.triangle_mesh();
    EXPECT_EQ(mesh.positions.size(), GetParam().vertices);
    EXPECT_EQ(mesh.triangles.size(), GetParam().triangles);
    for (const std::string& name :
         std::set<std::string>{"a.ply", "a" + path.extension().string()}) {
        write_file(folder / name, written(file, mesh, name));
        const TriangleMesh read = MeshFile(folder / name).triangle_mesh();
        EXPECT_EQ(read.positions, mesh.positions) << name;
        EXPECT_EQ(read.triangles.size(), mesh.triangles.size()) << name;
    }
    write_file(folder / "a.stl", written(file, mesh, "a.stl"));
    EXPECT_EQ(MeshFile(folder / "a.stl").triangle_mesh().triangles.size(), mesh.triangles.size());
}

INSTANTIATE_TEST_SUITE_P(Shared, RealMeshes,
                         ::testing::Values(RealMesh{"stanford_bunny.ply", 35947, 69451},
                                           RealMesh{"laurana50k.ply", 27861, 49954},
                                           RealMesh{"office_chair.ply", 3476, 6893},
                                           RealMesh{"nasty_soup.ply", 15360, 5120},
                                           RealMesh{"nasty_unreferenced.ply", 2613, 5123},
                                           RealMesh{"nasty_tiny.ply", 2562, 5120},
                                           RealMesh{"nasty_huge.ply", 2562, 5120},
                                           RealMesh{"nasty_far_offset.ply", 2562, 5120},
                                           RealMesh{"bunny10k_textured.obj", 5051, 9999},
                                           RealMesh{"human_neutral.obj", 10475, 20908}));

TEST(RealObj, TexturesAreKeptToTheLetter) {
    const auto path = std::filesystem::path(TRACKED_MCF_SHARED_MESHES) / "bunny10k_textured.obj";
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not here";
    const MeshFile file(path);
    EXPECT_EQ(written(file, file.triangle_mesh(), "a.obj"), read_file(path));
}

}  // namespace
}  // namespace tracked_mcf
