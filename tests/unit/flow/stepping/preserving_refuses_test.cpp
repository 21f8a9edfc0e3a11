// SPDX-License-Identifier: GPL-3.0-or-later
/// Surfaces whose area or volume cannot be preserved are refused, and stay as they are.
#include "filter_tracked_mcf/core/flow/stepping/preserving.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "filter_tracked_mcf/core/errors.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

/// Returns the message of the exception that evolve throws, or nothing. Expects an unchanged mesh.
template <class Error>
std::string complaint(const TriangleMesh& mesh, const FlowParameters& p,
                      const Selection& selection = {}) {
    TriangleMesh after = mesh;
    try {
        evolve(after, selection, p);
    } catch (const Error& error) {
        EXPECT_TRUE(same_bits(after, mesh));
        return error.what();
    }
    return {};
}

bool contains(const std::string& text, const char* part) {
    return text.find(part) != std::string::npos;
}

TEST(Preserving, ByScalingRejectsConstrainedVertices) {
    const TriangleMesh cap = bumpy_cap(10);
    EXPECT_TRUE(
        contains(complaint<InvalidParameter>(cap, preserving(Preserve::Area)), "must stay"));
    const TriangleMesh sphere = shapes::bumpy_sphere(10);
    EXPECT_TRUE(
        contains(complaint<InvalidParameter>(sphere, preserving(Preserve::Area), above(sphere, 0)),
                 "unselected"));
    FlowParameters conformalized = preserving(Preserve::Volume);
    conformalized.flow = FlowKind::Conformalized;
    EXPECT_TRUE(contains(complaint<InvalidParameter>(cap, conformalized), "must stay"));
    EXPECT_TRUE(contains(complaint<InvalidParameter>(sphere, conformalized, above(sphere, 0)),
                         "unselected"));
}

TEST(PreservingVolume, OrientsFacesAlikeAndRejectsSurfacesWhereThatIsNotPossible) {
    FlowParameters p = preserving(Preserve::Volume);
    for (const TriangleMesh& mesh : {shapes::bumpy_sphere(10), bumpy_cap(10)}) {
        TriangleMesh misoriented = mesh;
        for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
            std::swap(misoriented.triangles[i][0], misoriented.triangles[i][1]);
        TriangleMesh after = evolved(misoriented, p);
        after.triangles = mesh.triangles;
        EXPECT_TRUE(same_bits(after, evolved(mesh, p)));
    }
    EXPECT_TRUE(contains(complaint<InvalidMesh>(shapes::moebius_band(30, 5), p), "oriented"));
    // Only the triangles that flow count.
    TriangleMesh mesh = shapes::bumpy_sphere(10);
    const Selection top = above(mesh, 0);
    for (std::size_t i = 0; i < top.size(); i += 3) {
        if (top[i] == 0) std::swap(mesh.triangles[i][0], mesh.triangles[i][1]);
    }
    EXPECT_EQ(complaint<InvalidMesh>(mesh, p, top), "");
}

TEST(PreservingVolume, OfAConformalizedFlowRejectsSurfacesThatEncloseNone) {
    FlowParameters p = preserving(Preserve::Volume);
    p.flow = FlowKind::Conformalized;
    p.boundary = BoundaryCondition::Free;
    EXPECT_TRUE(contains(complaint<InvalidMesh>(bumpy_cap(10), p), "open"));
    const TriangleMesh flat = shapes::transformed(shapes::bumpy_sphere(10),
                                                  Eigen::Affine3d(Eigen::Scaling(1.0, 1.0, 0.0)));
    EXPECT_TRUE(contains(complaint<InvalidMesh>(flat, p), "encloses none"));
}

}  // namespace
}  // namespace tracked_mcf
