// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/bridge/mesh_bridge.h"

#include <gtest/gtest.h>
#include <vcg/complex/complex.h>

#include <cstring>
#include <limits>

namespace tracked_mcf {

namespace {

/// A minimal vcglib mesh of floats or doubles.
template <class Scalar>
struct Minimal {
    template <class Next>
    class Position : public vcg::vertex::Coord<vcg::Point3<Scalar>, Next> {};

    template <class Next>
    class Quality : public vcg::vertex::Quality<Scalar, Next> {};

    class Vertex;
    class Face;
    struct Types : vcg::UsedTypes<vcg::Use<Vertex>::template AsVertexType,
                                  vcg::Use<Face>::template AsFaceType> {};
    class Vertex : public vcg::Vertex<Types, Position, Quality, vcg::vertex::BitFlags> {};
    class Face : public vcg::Face<Types, vcg::face::VertexRef, vcg::face::BitFlags> {};
    class Mesh : public vcg::tri::TriMesh<std::vector<Vertex>, std::vector<Face>> {};
};

template <class Scalar>
class MeshBridge : public testing::Test {
protected:
    using Mesh = typename Minimal<Scalar>::Mesh;
    using Allocator = vcg::tri::Allocator<Mesh>;
    using Point = typename Mesh::CoordType;

    /// A strip of vertices 0 to 4, with the faces 012, 123 and 234.
    MeshBridge() {
        for (int i = 0; i < 5; ++i) {
            const auto x = static_cast<Scalar>(i);
            Allocator::AddVertex(mesh, Point(x, x * Scalar(0.1), Scalar(i % 2)));
        }
        for (std::size_t i = 0; i < 3; ++i) Allocator::AddFace(mesh, i, i + 1, i + 2);
    }

    Mesh mesh;
};

using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(MeshBridge, Scalars);

TYPED_TEST(MeshBridge, KeepsOrderAndPositionsExactly) {
    const TriangleMesh result = to_triangle_mesh(this->mesh);
    ASSERT_EQ(result.positions.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) {
        const auto& expected = this->mesh.vert[i].cP();
        EXPECT_EQ(result.positions[i], Eigen::Vector3d(expected[0], expected[1], expected[2]));
    }
    EXPECT_EQ(result.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 2, 3}, {2, 3, 4}}));
}

TYPED_TEST(MeshBridge, SkipsDeletedVerticesAndFaces) {
    TestFixture::Allocator::DeleteFace(this->mesh, this->mesh.face[0]);
    TestFixture::Allocator::DeleteVertex(this->mesh, this->mesh.vert[0]);
    const TriangleMesh result = to_triangle_mesh(this->mesh);
    EXPECT_EQ(result.positions.size(), 4u);
    EXPECT_EQ(result.triangles, (std::vector<Triangle>{{0, 1, 2}, {1, 2, 3}}));
}

TYPED_TEST(MeshBridge, MarksEveryKindOfDamagedReference) {
    typename Minimal<TypeParam>::Vertex stranger;
    this->mesh.face[0].V(0) = nullptr;
    this->mesh.face[1].V(0) = &stranger;
    TestFixture::Allocator::DeleteVertex(this->mesh, this->mesh.vert[4]);
    const TriangleMesh result = to_triangle_mesh(this->mesh);
    EXPECT_EQ(result.triangles, (std::vector<Triangle>{{-1, 1, 2}, {-1, 2, 3}, {2, 3, -1}}));
    EXPECT_THROW(validate(result), InvalidMesh);
}

TYPED_TEST(MeshBridge, FindsSelectedFacesDespiteWrongCounters) {
    EXPECT_FALSE(has_selected_faces(this->mesh));
    EXPECT_EQ(selected_faces(this->mesh), (Selection{0, 0, 0}));
    this->mesh.face[1].SetS();
    EXPECT_TRUE(has_selected_faces(this->mesh));
    EXPECT_EQ(selected_faces(this->mesh), (Selection{0, 1, 0}));
    this->mesh.face[2].SetS();
    TestFixture::Allocator::DeleteFace(this->mesh, this->mesh.face[1]);
    EXPECT_EQ(selected_faces(this->mesh), (Selection{0, 1}));
    TestFixture::Allocator::DeleteFace(this->mesh, this->mesh.face[2]);
    EXPECT_FALSE(has_selected_faces(this->mesh));
}

TYPED_TEST(MeshBridge, WritesPositionsPastDeletedVertices) {
    TestFixture::Allocator::DeleteVertex(this->mesh, this->mesh.vert[1]);
    const auto deleted = this->mesh.vert[1].cP();
    TriangleMesh moved = to_triangle_mesh(this->mesh);
    for (Eigen::Vector3d& position : moved.positions) position *= 2;
    write_positions(moved, this->mesh);
    EXPECT_EQ(this->mesh.vert[1].cP(), deleted);
    EXPECT_EQ(this->mesh.vert[4].cP()[0], TypeParam(8));
}

TYPED_TEST(MeshBridge, WritesQualityPastDeletedVertices) {
    TestFixture::Allocator::DeleteVertex(this->mesh, this->mesh.vert[1]);
    this->mesh.vert[1].Q() = 7;
    write_quality({0.5, -1, 2, 3}, this->mesh);
    const TypeParam expected[] = {TypeParam(0.5), 7, -1, 2, 3};
    for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(this->mesh.vert[i].Q(), expected[i]);
}

TYPED_TEST(MeshBridge, ReadsQualityPastDeletedVertices) {
    for (std::size_t i = 0; i < 5; ++i) this->mesh.vert[i].Q() = TypeParam(i) / 8;
    TestFixture::Allocator::DeleteVertex(this->mesh, this->mesh.vert[1]);
    EXPECT_EQ(vertex_quality(this->mesh), (std::vector<double>{0, 0.25, 0.375, 0.5}));
}

TYPED_TEST(MeshBridge, AVertexThatDidNotMoveKeepsItsBits) {
    const TypeParam nan = std::numeric_limits<TypeParam>::signaling_NaN();
    const TypeParam tiny = std::numeric_limits<TypeParam>::denorm_min();
    this->mesh.vert[0].P() = {nan, -TypeParam(0), tiny};
    this->mesh.vert[1].P() = {-TypeParam(0), tiny, std::numeric_limits<TypeParam>::max()};
    const auto before = this->mesh.vert;
    write_positions(to_triangle_mesh(this->mesh), this->mesh);
    for (std::size_t i = 0; i < before.size(); ++i) {
        const auto was = before[i].cP();
        const auto is = this->mesh.vert[i].cP();
        // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): the test compares bits, not values
        EXPECT_EQ(std::memcmp(was.V(), is.V(), 3 * sizeof(TypeParam)), 0);
    }
}

TYPED_TEST(MeshBridge, RefusesToWriteToAMeshThatLostVertices) {
    const TriangleMesh moved = to_triangle_mesh(this->mesh);
    TestFixture::Allocator::DeleteVertex(this->mesh, this->mesh.vert[1]);
    EXPECT_THROW(write_positions(moved, this->mesh), InvalidMesh);
}

}  // namespace

}  // namespace tracked_mcf
