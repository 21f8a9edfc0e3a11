// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/paper/transfer.h"

#include <gtest/gtest.h>

#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

TEST(Prolongation, KeepsConstants) {
    const System system(shapes::bumpy_sphere(8), 4, 0.5F);
    for (std::size_t level = 1; level <= 4; ++level) {
        const SparseMatrix p =
            prolongation(system.elements.levels[level], system.elements.levels[level - 1]);
        const Eigen::VectorXf ones = p * Eigen::VectorXf::Ones(p.cols());
        EXPECT_EQ(ones, Eigen::VectorXf::Ones(p.rows()));
    }
}

}  // namespace
}  // namespace tracked_mcf
