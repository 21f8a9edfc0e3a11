#include "filter_tracked_mcf/core/element_smoother.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "tests/support/shapes.h"
#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

/// Small enough for one block, so that sweeps go through the elements in order.
System small_system(bool lock = false) {
    TriangleMesh mesh = shapes::bumpy_sphere(6);
    if (lock) mesh.triangles.resize(mesh.triangles.size() / 2);
    return System(mesh, 3, 0.5F, {lock, 0.01});
}

Field random_field(const System& system) {
    Field field = Field::Random(4, system.elements.finest().unknown_count());
    field.row(3).setZero();
    return field;
}

/// Solves for the unknowns of one element after the other, in double.
Dense swept(const System& system, const Dense& a, const Dense& b, Dense x) {
    for (const auto& unknowns : system.elements.finest().unknowns) {
        Dense local(8, 8), residual(8, b.cols());
        for (int i = 0; i < 8; ++i) {
            residual.row(i) = b.row(unknowns[i]) - a.row(unknowns[i]) * x;
            for (int j = 0; j < 8; ++j) local(i, j) = a(unknowns[i], unknowns[j]);
        }
        const Dense correction = local.llt().solve(residual);
        for (int i = 0; i < 8; ++i) x.row(unknowns[i]) += correction.row(i);
    }
    return x;
}

TEST(ElementSmoother, SolvesForOneElementAfterTheOther) {
    const System system = small_system();
    const LevelMatrix& matrix = system.multigrid.finest();
    ElementSmoother smoother(system.elements.finest());
    smoother.refresh(matrix);
    Field x = random_field(system);
    const Dense a = dense(matrix.matrix());
    const Dense expected = swept(system, a, system.right_side.cast<double>().transpose(),
                                 x.cast<double>().transpose());
    smoother.sweep(matrix, system.right_side, x);
    const Dense error = x.cast<double>().transpose() - expected;
    EXPECT_LT(error.norm(), 1e-3 * expected.norm());
    EXPECT_LT(error.cwiseProduct(a * error).sum(),
              1e-6 * expected.cwiseProduct(a * expected).sum());
}

TEST(ElementSmoother, BackwardIsTheAdjointOfForward) {
    const System system(shapes::bumpy_sphere(20), 5, 0.5F, {false, 0.01});  // several blocks
    const LevelMatrix& matrix = system.multigrid.finest();
    ElementSmoother smoother(system.elements.finest());
    smoother.refresh(matrix);
    const Field a = random_right_side(system), b = random_right_side(system);
    Field forward = system.zero(), backward = system.zero();
    smoother.sweep(matrix, a, forward);
    smoother.sweep_backward(matrix, b, backward);
    const Eigen::Vector4d one = dot(b, forward), other = dot(a, backward);
    EXPECT_LT((one - other).norm(), 1e-4 * one.norm());
    EXPECT_GT(one.norm(), 0);
}

TEST(ElementSmoother, LeavesFrozenUnknownsAlone) {
    const System system = small_system(true);
    ElementSmoother smoother(system.elements.finest());
    smoother.refresh(system.multigrid.finest());
    Field x = system.zero();
    smoother.sweep(system.multigrid.finest(), random_field(system), x);
    smoother.sweep_backward(system.multigrid.finest(), random_field(system), x);
    int frozen = 0;
    for (std::int32_t i = 0; i < x.cols(); ++i) {
        EXPECT_EQ(x.col(i).isZero(0), system.frozen.back()[i] != 0);
        frozen += system.frozen.back()[i];
    }
    EXPECT_GT(frozen, 20);
}

TEST(ElementSmoother, TakesFunctionsThatDepend) {
    // A flat patch in a grid plane, not stabilised: of an element's functions four are zero on it.
    const System system(shapes::square(8), 2, 0.5F);
    ElementSmoother smoother(system.elements.finest());
    smoother.refresh(system.multigrid.finest());
    Field x = random_field(system);
    double before = system.residual(x);
    for (int i = 0; i < 4; ++i) {
        smoother.sweep(system.multigrid.finest(), system.right_side, x);
        EXPECT_TRUE(x.allFinite());
        EXPECT_LT(system.residual(x), 0.5 * before);
        before = system.residual(x);
    }
}

}  // namespace
}  // namespace tracked_mcf
