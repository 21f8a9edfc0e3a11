// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/system/edge_metric.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "filter_tracked_mcf/core/system/element_matrices.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

TrackedElements elements_of(const TriangleMesh& mesh, int depth, const FlowParameters& parameters) {
    const Domain domain(mesh, parameters.boundary);
    return build_tracked_elements(domain, clip_to_grid(mesh, enclosing_grid(mesh, depth)),
                                  parameters);
}

FlowParameters keeping(double angle) {
    FlowParameters parameters;
    parameters.keep_edges = angle;
    return parameters;
}

Coefficients no_displacement(const TrackedElements& elements) {
    return Coefficients::Zero(elements.finest().unknown_count(), 3);
}

TEST(EdgeMetric, ACylinderCountsAsLongAroundItsAxis) {
    // On a cylinder of radius R, the normal turns by an arc's length over R, so that arcs count
    // √(1 + s²/R²) times.
    const TriangleMesh tube = shapes::tube(200, 40, 2);
    FlowParameters parameters = keeping(60);
    parameters.boundary = BoundaryCondition::Free;
    const TrackedElements elements = elements_of(tube, 5, parameters);
    const double cell = elements.grid.cell_size;
    EdgeMetric metric(Domain(tube, parameters.boundary), elements, {0.5 / cell, 60}, false);
    metric.update(elements, no_displacement(elements));
    const double s = 0.5;  // twice the sine of half the angle is 1
    ElementSystems plain, stretched;
    assemble_elements(elements, no_displacement(elements), {1, 0}, plain);
    assemble_elements(elements, no_displacement(elements),
                      {1, 0, FlowKind::MeanCurvature, false, metric.tensors().data()}, stretched);
    double area = 0, stretched_area = 0;
    for (std::int64_t element = 0; element < plain.matrices.size(); ++element) {
        const auto sum = [element](const MatrixBlocks& matrices) {
            const ElementMatrix matrix = matrices.of(element);
            return Eigen::Map<const Eigen::Matrix<float, 8, 8>>(matrix.entry[0]).sum();
        };
        area += sum(plain.matrices);
        stretched_area += sum(stretched.matrices);
    }
    EXPECT_NEAR(stretched_area / area, std::sqrt(1 + s * s), 0.01 * std::sqrt(1 + s * s));
}

TEST(EdgeMetric, EdgesAreWhereTheNormalTurnsByTheAngleWithinTheDetailSize) {
    const TriangleMesh cube = shapes::box(40, {1, 1, 1});
    const TrackedElements elements = elements_of(cube, 5, keeping(30));
    const double detail_size = 3 * 0.025 / elements.grid.cell_size;
    const Domain domain(cube, BoundaryCondition::Locked);
    EdgeMetric metric(domain, elements, {detail_size, 30}, false);
    metric.update(elements, no_displacement(elements));
    // Two rows of triangles beside each edge of the cube, of forty rows on each face.
    EXPECT_GT(metric.edge_share(), 0.05);
    EXPECT_LT(metric.edge_share(), 0.3);
    const TriangleMesh sphere = shapes::geodesic_sphere(20);
    const TrackedElements round = elements_of(sphere, 5, keeping(30));
    EdgeMetric none(Domain(sphere, BoundaryCondition::Locked), round,
                    {0.2 / round.grid.cell_size, 30}, false);
    none.update(round, no_displacement(round));
    EXPECT_EQ(none.edge_share(), 0);
}

TEST(EdgeMetric, ARimIsNoEdge) {
    const TriangleMesh cap = bumpy_cap(12);
    const TrackedElements elements = elements_of(cap, 5, keeping(40));
    const Domain domain(cap, BoundaryCondition::Locked);
    EdgeMetric metric(domain, elements, {3, 40}, false);
    metric.update(elements, no_displacement(elements));
    EXPECT_EQ(metric.edge_share(), 0);
}

TEST(EdgeMetric, StepsAreLongerForNoiseButNotForDetail) {
    const TriangleMesh clean = shapes::box(20, {1, 1, 1}), rough = noisy(clean, 0.01);
    const TrackedElements elements = elements_of(clean, 5, keeping(25));
    const double detail_size = 3 * 0.05 / elements.grid.cell_size;
    const auto metric_of = [&](const TriangleMesh& mesh) {
        return EdgeMetric(Domain(mesh, BoundaryCondition::Locked), elements, {detail_size, 25},
                          false);
    };
    EdgeMetric none = metric_of(clean);
    EXPECT_NEAR(none.step_factor(), 1, 1e-3);
    EXPECT_LT(none.noise(), 1e-3 * detail_size);
    EdgeMetric noise = metric_of(rough);
    const double factor = noise.step_factor();
    EXPECT_GT(factor, 2);
    EXPECT_FALSE(noise.shorten_steps(0.8 * noise.noise()));
    EXPECT_FALSE(noise.shorten_steps(0.91 * noise.noise())) << "too little to make it again";
    EXPECT_EQ(noise.step_factor(), factor);
    EXPECT_TRUE(noise.shorten_steps(1.1 * noise.noise()));
    EXPECT_LT(noise.step_factor(), 0.5 * factor);
    EXPECT_TRUE(noise.shorten_steps(100 * noise.noise()));
    EXPECT_EQ(noise.step_factor(), 1);
    EXPECT_FALSE(noise.shorten_steps(100 * noise.noise()));
}

}  // namespace
}  // namespace tracked_mcf
