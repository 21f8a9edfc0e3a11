// Flowing a mesh that was moved, scaled or turned is flowing it, then moving, scaling or turning
// it.

#include <gtest/gtest.h>

#include "filter_tracked_mcf/core/evolve.h"
#include "tests/support/shapes.h"
#include "tests/unit/flows.h"

namespace tracked_mcf {
namespace {

TEST(Symmetry, CommutesWithTranslation) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    const Eigen::Affine3d shift(Eigen::Translation3d(3.7, -11.3, 5.1));
    const FlowParameters p = parameters(5, 1e-4, 5);
    EXPECT_LT(distance(evolved(shapes::transformed(mesh, shift), p),
                       shapes::transformed(evolved(mesh, p), shift)),
              1e-6);
}

TEST(Symmetry, CommutesWithScaling) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    const FlowParameters p = parameters(5, 1e-4, 5);
    for (const double scale : {1e-9, 0.3, 7.0, 1e12}) {
        const Eigen::Affine3d scaling(Eigen::Scaling(scale));
        EXPECT_LT(distance(evolved(shapes::transformed(mesh, scaling), p),
                           shapes::transformed(evolved(mesh, p), scaling)),
                  1e-6 * scale);
    }
}

// The equations of a mesh turned by 90 degrees are the same to rounding, but smoothers go through
// them in another order, so what is left is the solver's error: it falls as the solver converges.
double effect_of_a_quarter_turn(int axis, const FlowParameters& p) {
    const TriangleMesh mesh = shapes::bumpy_sphere(20);
    const Eigen::Vector3d around = Eigen::Vector3d::Unit(axis);
    return distance(evolved(turned(mesh, kQuarterTurn, around), p),
                    turned(evolved(mesh, p), kQuarterTurn, around));
}

TEST(Symmetry, CommutesWithQuarterTurnsAsCyclesConverge) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto difference = [&](int cycles) {
            FlowParameters p = parameters(4, 1e-3, 1);
            p.solver = Solver::OneWCycle;
            p.cycles = cycles;
            return effect_of_a_quarter_turn(axis, p);
        };
        const double of_one_cycle = difference(1);
        EXPECT_LT(difference(10), 0.2 * of_one_cycle);
        EXPECT_LT(difference(100), 1e-6);  // rounding of single precision
    }
}

TEST(Symmetry, CommutesWithQuarterTurnsToTheTolerance) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto difference = [&](double tolerance) {
            FlowParameters p = parameters(4, 1e-3, 1);
            p.tolerance = tolerance;
            return effect_of_a_quarter_turn(axis, p);
        };
        EXPECT_LT(difference(1e-4), 1e-4);
        EXPECT_LT(difference(1e-8), 1e-6);  // rounding of single precision
    }
}

}  // namespace
}  // namespace tracked_mcf
