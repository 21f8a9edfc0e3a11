// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <limits>

#include "filter_tracked_mcf/core/octree/sheets.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "tests/support/elements.h"
#include "tests/support/shapes.h"
#include "tests/unit/memory/address_space_limit.h"

namespace tracked_mcf {
namespace {

TEST(Sheets, TakeNoMemoryForVerticesAndEdgesOutsideTheirCells) {
    if (TRACKED_MCF_SANITIZED) GTEST_SKIP() << "sanitizers need the whole address space";
    const TriangleMesh mesh = shapes::bumpy_sphere(12);
    ClippedSurface surface = clip_to_grid(mesh, enclosing_grid(mesh, 5));
    MeshTopology topology = topology_of(mesh);
    // The surface is a small selection of the largest mesh.
    topology.edge_count = std::numeric_limits<std::int32_t>::max();
    const ThreadTeam threads(1);
    const AddressSpaceLimit limit(100'000'000);
    EXPECT_NO_THROW(separate_sheets(topology, surface.fragments));
}

}  // namespace
}  // namespace tracked_mcf
