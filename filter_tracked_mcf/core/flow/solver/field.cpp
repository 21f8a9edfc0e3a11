// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/field.h"

#include <cmath>

#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

void set_zero(Field& field, Eigen::Index count) {
    field.resize(4, count);
    // In parallel, because the first access to fresh memory is slow.
    parallel_for_rows(count, [&](std::int32_t i) { field.col(i).setZero(); });
}

void sum_at_unknowns(const Level& level, const Field& at_corners, Field& sums) {
    sums.resize(4, level.unknown_count());
    parallel_for_rows(level.unknown_count(), [&](std::int32_t unknown) {
        Eigen::Vector4f sum = Eigen::Vector4f::Zero();
        for (const std::int32_t index : level.corners.members(unknown))
            sum += at_corners.col(index);
        sums.col(unknown) = sum;
    });
}

void copy(const Field& from, Field& to) {
    to.resize(4, from.cols());
    parallel_for_rows(from.cols(), [&](std::int32_t i) { to.col(i) = from.col(i); });
}

Eigen::Vector4d dot(const Field& a, const Field& b) {
    const Eigen::Vector4d zero = Eigen::Vector4d::Zero();
    return parallel_sum(a.cols(), zero, [&](std::int64_t begin, std::int64_t end) {
        Eigen::Vector4d sum = Eigen::Vector4d::Zero();
        for (std::int64_t i = begin; i < end; ++i) {
            sum += a.col(i).cast<double>().cwiseProduct(b.col(i).cast<double>());
        }
        return sum;
    });
}

double norm(const Field& field) {
    return std::sqrt(dot(field, field).sum());
}

}  // namespace tracked_mcf
