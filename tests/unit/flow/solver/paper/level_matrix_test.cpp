// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/paper/level_matrix.h"

#include <gtest/gtest.h>

#include "tests/unit/system.h"

namespace tracked_mcf {
namespace {

TEST(LevelMatrix, IsTheSumOfItsElementMatrices) {
    const System system(shapes::bumpy_sphere(6), 3, 0.5F);
    const Dense expected = assembled(system.levels());
    const Dense matrix = dense(system.multigrid.finest().matrix());
    EXPECT_LT((matrix - expected).norm(), 1e-6 * expected.norm());
    EXPECT_LT((matrix - matrix.transpose()).norm(), 1e-6 * matrix.norm());
}

}  // namespace
}  // namespace tracked_mcf
