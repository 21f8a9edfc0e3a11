// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/system/pinches.h"

#include <gtest/gtest.h>

#include "tests/support/elements.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

TEST(Pinches, ConstrainsFunctionsWhoseSurfaceHasCollapsed) {
    const TriangleMesh mesh = shapes::bumpy_sphere(12);
    const TrackedElements elements = build_tracked_elements(
        Domain(mesh, BoundaryCondition::Locked), enclosing_grid(mesh, 4), Cubature::ThreePoints);
    const Level& finest = elements.finest();
    const Coefficients identity = identity_coefficients(elements);
    const double middle = 0.5 * (identity.col(0).minCoeff() + identity.col(0).maxCoeff());
    Coefficients displacement = Coefficients::Zero(identity.rows(), 3);
    // The lower half collapses to a point.
    for (Eigen::Index i = 0; i < identity.rows(); ++i) {
        if (identity(i, 0) < middle) displacement.row(i) = -identity.row(i);
    }
    ElementSystems systems;
    assemble_elements(elements, displacement, {1, 1}, systems);
    std::vector<std::int64_t> samples(finest.unknown_count(), 0);
    std::vector<std::int64_t> collapsed(finest.unknown_count(), 0);
    for (std::int32_t element = 0; element < finest.element_count(); ++element) {
        for (const std::int32_t unknown : finest.unknowns[element]) {
            samples[unknown] += elements.sample_begin[element + 1] - elements.sample_begin[element];
        }
    }
    for (const Collapse& collapse : systems.collapses) {
        for (const std::int32_t unknown : finest.unknowns[collapse.element]) {
            collapsed[unknown] += collapse.samples;
        }
    }
    const Supports supports = measure_supports(elements);
    for (const float share : {0.0F, 0.5F, 0.99F}) {
        std::vector<std::uint8_t> constrained(samples.size(), 0);
        constrain_pinched(elements, supports, systems, share, constrained);
        int wholly = 0, not_at_all = 0;
        for (std::size_t unknown = 0; unknown < samples.size(); ++unknown) {
            if (collapsed[unknown] == 0) {
                EXPECT_EQ(constrained[unknown], 0);
                ++not_at_all;
            } else if (collapsed[unknown] == samples[unknown] && supports.mass[unknown] > 0) {
                EXPECT_EQ(constrained[unknown], 1);
                ++wholly;
            }
        }
        EXPECT_GT(wholly, 100);
        EXPECT_GT(not_at_all, 100);
    }
}

}  // namespace
}  // namespace tracked_mcf
