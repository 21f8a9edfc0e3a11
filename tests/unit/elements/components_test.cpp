// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "tests/support/elements.h"
#include "tests/support/shapes.h"

namespace tracked_mcf {
namespace {

/// Three shells. The first two are so close that they share cells, and the third is far away.
TriangleMesh three_shells() {
    const TriangleMesh sphere = shapes::bumpy_sphere(10);
    const TriangleMesh inner = shapes::transformed(sphere, Eigen::Affine3d(Eigen::Scaling(0.97)));
    const TriangleMesh beside =
        shapes::transformed(sphere, Eigen::Affine3d(Eigen::Translation3d(4, 1, 0)));
    return shapes::merged(shapes::merged(sphere, inner), beside);
}

TrackedElements elements_of(const TriangleMesh& mesh, bool separate_sheets) {
    return build_tracked_elements(mesh, enclosing_grid(mesh, 4), Cubature::ThreePoints,
                                  separate_sheets);
}

TEST(Components, AreThoseOfTheMesh) {
    const TriangleMesh mesh = three_shells();
    const TrackedElements elements = elements_of(mesh, true);
    const std::vector<std::int32_t>& component_of = elements.components.of_element;
    ASSERT_EQ(elements.components.count, 3);
    ASSERT_EQ(static_cast<std::int32_t>(component_of.size()), elements.finest().element_count());
    // The vertices of each shell are in elements of one component, another one for each shell.
    std::set<std::int32_t> components;
    const std::size_t vertices_each = mesh.positions.size() / 3;
    for (std::size_t shell = 0; shell < 3; ++shell) {
        const auto component_of_vertex = [&](std::size_t i) {
            return component_of[elements.vertices[shell * vertices_each + i].element];
        };
        for (std::size_t i = 1; i < vertices_each; ++i) {
            EXPECT_EQ(component_of_vertex(i), component_of_vertex(0));
        }
        components.insert(component_of_vertex(0));
    }
    EXPECT_EQ(components, (std::set<std::int32_t>{0, 1, 2}));
}

TEST(Components, AreOneWithoutSeparateSheets) {
    const TrackedElements elements = elements_of(three_shells(), false);
    EXPECT_EQ(elements.components.count, 1);
    const std::vector<std::int32_t>& component_of = elements.components.of_element;
    EXPECT_EQ(std::count(component_of.begin(), component_of.end(), 0),
              elements.finest().element_count());
}

TEST(Components, OfAnUnknownIsThatOfAllItsElements) {
    const TrackedElements elements = elements_of(three_shells(), true);
    const auto& [count, of_element, of_unknown] = elements.components;
    ASSERT_EQ(static_cast<std::int32_t>(of_unknown.size()), elements.finest().unknown_count());
    for (std::size_t element = 0; element < of_element.size(); ++element) {
        for (const std::int32_t unknown : elements.finest().unknowns[element]) {
            EXPECT_EQ(of_unknown[unknown], of_element[element]);
        }
    }
}

}  // namespace
}  // namespace tracked_mcf
