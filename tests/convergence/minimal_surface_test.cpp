// SPDX-License-Identifier: GPL-3.0-or-later
// A flow with a locked boundary converges to a minimal surface.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>

#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/flow/flow.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "tests/support/minimal_surfaces.h"
#include "tests/support/plans.h"
#include "tests/support/shapes.h"
#include "tests/support/surface_distance.h"

namespace tracked_mcf {
namespace {

using Eigen::Vector3d;

constexpr auto kLocked = BoundaryCondition::Locked;
constexpr auto kLockedCells = BoundaryCondition::LockedCells;
constexpr auto kFree = BoundaryCondition::Free;

constexpr int kStepsToMinimiser = 40;
constexpr double kLongStep = 4;
constexpr std::array<int, 4> kDepths = {4, 5, 6, 7};

/// Returns a grid of the cube [-1.1, 1.1]³, for every rotation of the mesh.
Grid grid_of_depth(int depth) {
    return with_depth({Vector3d::Constant(-1.1), 2.2, 0}, depth);
}

TriangleMesh flowed(TriangleMesh mesh, const Grid& grid, BoundaryCondition boundary,
                    double step_size) {
    FlowParameters parameters;
    parameters.boundary = boundary;
    parameters.step_size = step_size;
    Flow flow(plan_of(mesh, parameters, grid));
    for (int step = 0; step < kStepsToMinimiser; ++step) EXPECT_TRUE(flow.step());
    flow.move_vertices(mesh.positions);
    return mesh;
}

/// Returns the lowest order of `errors` between two consecutive depths, down to the mesh's own
/// error.
double least_order(const std::array<double, kDepths.size()>& errors, double mesh_error) {
    double least = 10;
    for (std::size_t i = 1; i < errors.size() && errors[i - 1] > 2 * mesh_error; ++i) {
        least = std::min(least, std::log2(errors[i - 1] / errors[i]));
    }
    return least;
}

class CatenoidFlow : public testing::Test {
protected:
    /// Returns the cylinder between the rings after the flow has brought it to rest.
    TriangleMesh flowed_tube(int depth, BoundaryCondition boundary,
                             double step_size = kLongStep) const {
        const TriangleMesh tube = shapes::tube(360, 48, catenoid_.height());
        const TriangleMesh moved =
            flowed(shapes::transformed(tube, turn_), grid_of_depth(depth), boundary, step_size);
        return shapes::transformed(moved, turn_.inverse());
    }
    double error(int depth, BoundaryCondition boundary) const {
        const double rms = catenoid_.rms_offset(flowed_tube(depth, boundary).positions);
        std::printf("depth %d: %.2e\n", depth, rms);
        return rms;
    }
    std::array<double, kDepths.size()> errors() const {
        std::array<double, kDepths.size()> errors = {};
        for (std::size_t i = 0; i < errors.size(); ++i) errors[i] = error(kDepths[i], kLocked);
        return errors;
    }
    void tilt() { turn_ = Eigen::AngleAxisd(0.3, Vector3d(1, 0.3, 0.2).normalized()); }

    const Catenoid catenoid_{0.8};
    /// The largest distance of a circle from its 360 chords.
    const double mesh_error_ = 1 - std::cos(std::acos(-1.0) / 360);

private:
    Eigen::Affine3d turn_ = Eigen::Affine3d::Identity();
};

TEST_F(CatenoidFlow, AlongTheGridTheErrorIsThatOfTheChords) {
    const auto errors = this->errors();
    EXPECT_GE(least_order(errors, mesh_error_), 1.5);
    const TriangleMesh at_rest = flowed_tube(5, kLocked);
    EXPECT_LE(errors[1], 1.1 * catenoid_.rms_of_chords(at_rest.positions, grid_of_depth(5)));
    EXPECT_GE(error(5, kLockedCells), 10 * errors[1]);
}

TEST_F(CatenoidFlow, ConvergesObliqueToTheGrid) {
    tilt();
    const auto errors = this->errors();
    EXPECT_GE(least_order(errors, mesh_error_), 1.5);
    EXPECT_LE(errors[1], 3e-4);
    EXPECT_GE(error(5, kLockedCells), 10 * errors[1]);
}

TEST_F(CatenoidFlow, ConvergesForAnyStepSize) {
    tilt();
    const TriangleMesh usual = flowed_tube(5, kLocked);
    for (const double step_size : {0.1, 1.0, 100.0}) {
        const double distance = normal_distance(flowed_tube(5, kLocked, step_size), usual).rms;
        std::printf("step size %g: %.1e\n", step_size, distance);
        EXPECT_LT(distance, 2e-5) << step_size;
    }
}

TEST(FlowOnTheMesh, ReachesTheCatenoidInAnyNumberOfStepsWithoutAFold) {
    const Catenoid catenoid(0.8);
    const TriangleMesh tube = shapes::tube(96, 40, catenoid.height());
    const double chords = 1 - std::cos(std::acos(-1.0) / 96);
    for (const auto& [step_size, steps] : {std::pair{1.0, 20}, {0.01, 200}, {0.002, 1000}}) {
        FlowParameters parameters;
        parameters.step_size = step_size;
        parameters.absolute = true;
        parameters.iterations = steps;
        TriangleMesh after = tube;
        EXPECT_EQ(evolve(after, parameters).stop, Stop::None);
        const double offset = catenoid.rms_offset(after.positions);
        std::printf("%d steps of %g: %.2e\n", steps, step_size, offset);
        EXPECT_LT(offset, 2 * chords) << steps;
        for (const Triangle& t : tube.triangles) {
            EXPECT_GT(twice_vector_area(after, t).dot(twice_vector_area(tube, t)), 0) << steps;
        }
    }
}

TEST(EnneperFlow, ConvergesWithAnOrderOfOneAndAHalf) {
    const Enneper surface(0.8);
    const Eigen::Affine3d turn(Eigen::AngleAxisd(0.4, Vector3d(1, 2, 0.5).normalized()));
    const TriangleMesh cone = shapes::transformed(surface.cone(360, 40), turn);
    std::array<double, kDepths.size()> errors = {};
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const TriangleMesh moved = shapes::transformed(
            flowed(cone, grid_of_depth(kDepths[i]), kLocked, kLongStep), turn.inverse());
        double squares = 0;
        for (const Vector3d& position : moved.positions) {
            squares += std::pow(surface.distance(position), 2);
        }
        errors[i] = std::sqrt(squares / static_cast<double>(moved.positions.size()));
        std::printf("depth %d: %.2e\n", kDepths[i], errors[i]);
    }
    // A fit, because the order varies with the boundary's position in the cells.
    EXPECT_GE(std::log2(errors.front() / errors.back()) / 3, 1.5);
}

/// Boundary, flow, solver, and whether the plane is oblique to the grid.
using FlatCase = std::tuple<BoundaryCondition, FlowKind, Solver, bool>;

class FlatFlow : public testing::TestWithParam<FlatCase> {
protected:
    FlowParameters parameters() const {
        FlowParameters parameters;
        parameters.depth = 5;
        parameters.step_size = 0.01;
        parameters.iterations = 10;
        std::tie(parameters.boundary, parameters.flow, parameters.solver, std::ignore) = GetParam();
        return parameters;
    }
    static Eigen::Affine3d placement() {
        const Eigen::Affine3d shift(Eigen::Translation3d(0.3, -0.2, 0.1));
        const Eigen::AngleAxisd turn(0.7, Vector3d(1, 2, 0.5).normalized());
        return std::get<bool>(GetParam()) ? turn * shift : shift;
    }
};

TEST_P(FlatFlow, StaysInItsPlane) {
    const TriangleMesh before = shapes::transformed(shapes::annulus(120, 20, 0.4, 1), placement());
    TriangleMesh after = before;
    if (parameters().solver == Solver::Converged && parameters().boundary == kLockedCells) {
        GTEST_SKIP() << "has no cells to lock";
    }
    evolve(after, parameters());
    const Vector3d normal = placement().linear().col(2);
    double off = 0;
    for (std::size_t i = 0; i < before.positions.size(); ++i) {
        off = std::max(off, std::abs((after.positions[i] - before.positions[i]).dot(normal)));
    }
    const double moved = worst_distance(after, before);
    std::printf("off the plane by %.1e, moved by %.1e\n", off, moved);
    EXPECT_LT(off, 1e-6 + 5e-5 * moved);  // rounding of single precision
    if (parameters().boundary == kFree) {
        EXPECT_LT(surface_area(after), 0.9 * surface_area(before));
    } else {
        EXPECT_LT(moved, 1e-5);
    }
}

std::string name_of(const testing::TestParamInfo<FlatCase>& test) {
    const auto [boundary, flow, solver, is_oblique] = test.param;
    const std::string name = boundary == kLocked        ? "Locked"
                             : boundary == kLockedCells ? "LockedCells"
                                                        : "Free";
    return name + (flow == FlowKind::Conformalized ? "_Conformalized" : "_MeanCurvature") +
           (solver == Solver::Converged ? "_Converged"
            : solver == Solver::Grid    ? "_Grid"
                                        : "_OneWCycle") +
           (is_oblique ? "_Oblique" : "_Aligned");
}

INSTANTIATE_TEST_SUITE_P(
    AnAnnulus, FlatFlow,
    testing::Combine(testing::Values(kLocked, kLockedCells, kFree),
                     testing::Values(FlowKind::MeanCurvature, FlowKind::Conformalized),
                     testing::Values(Solver::Converged, Solver::Grid, Solver::OneWCycle),
                     testing::Bool()),
    name_of);

}  // namespace
}  // namespace tracked_mcf
