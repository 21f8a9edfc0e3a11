// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/field.h"

#include <gtest/gtest.h>

#include <vector>

#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {
namespace {

constexpr Eigen::Index kCount = 50 * kChunkSize + 3;

TEST(Field, DotAndNormEqualTheSumsInDouble) {
    const Field a = Field::Random(4, kCount), b = Field::Random(4, kCount);
    const Eigen::Vector4d expected =
        a.cast<double>().cwiseProduct(b.cast<double>()).rowwise().sum();
    EXPECT_LT((dot(a, b) - expected).norm(), 1e-10 * kCount);
    EXPECT_NEAR(norm(a), a.cast<double>().norm(), 1e-10 * norm(a));
}

TEST(Field, DotHasTheSameBitsWithAnyNumberOfThreads) {
    const Field a = Field::Random(4, kCount), b = Field::Random(4, kCount);
    std::vector<Eigen::Vector4d> results;
    for (const int count : {1, 2, 3, 8}) {
        const ThreadTeam threads(count);
        results.push_back(dot(a, b));
        EXPECT_EQ(results.back(), results.front());
    }
}

TEST(Field, CopyAndSetZeroResizeTheField) {
    const Field a = Field::Random(4, kCount);
    Field b;
    copy(a, b);
    EXPECT_EQ(b, a);
    set_zero(b, 7);
    EXPECT_EQ(b, Field::Zero(4, 7));
}

}  // namespace
}  // namespace tracked_mcf
