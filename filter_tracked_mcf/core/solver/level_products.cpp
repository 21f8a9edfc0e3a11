// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/solver/level_products.h"

#include "filter_tracked_mcf/core/kernels/kernels.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"
#include "filter_tracked_mcf/core/solver/element_bricks.h"

namespace tracked_mcf {

void subtract_products(const ElementPartition& partition, const MatrixBlocks& matrices,
                       const Field& right_side, const Field& x, Field& residual) {
    partition.sum(&right_side, residual, [&](const ElementRange& range, float* sum) {
        kernels().add_element_products(range, matrices.blocks(), -1, x.data(), sum);
        return 0.0;
    });
}

void subtract_products(const Level& level, const MatrixBlocks& matrices, const Field& right_side,
                       const Coefficients& x, Field& residual) {
    Coefficients sum = right_side.topRows<3>().transpose().cast<double>();
    ElementBricks(level).for_each([&](std::int32_t begin, std::int32_t end) {
        for (std::int32_t element = begin; element < end; ++element) {
            const auto& unknowns = level.unknowns[element];
            for (int i = 0; i < 8; ++i) {
                Eigen::RowVector3d product = Eigen::RowVector3d::Zero();
                for (int j = 0; j < 8; ++j) {
                    product += matrices.at(element, i, j) * x.row(unknowns[j]);
                }
                sum.row(unknowns[i]) -= product;
            }
        }
    });
    set_zero(residual, level.unknown_count());
    parallel_for_rows(level.unknown_count(), [&](std::int32_t unknown) {
        residual.col(unknown).head<3>() = sum.row(unknown).transpose().cast<float>();
    });
}

double multiply(const ElementPartition& partition, const MatrixBlocks& matrices, const Field& x,
                Field& y) {
    return partition.sum(nullptr, y, [&](const ElementRange& range, float* sum) {
        return kernels().add_element_products_and_dot(range, matrices.blocks(), x.data(), sum);
    });
}

void sum_vectors(const ElementPartition& partition, const std::vector<ElementVector>& vectors,
                 Field& result) {
    partition.sum(nullptr, result, [&](const ElementRange& range, float* sums) {
        for (std::int32_t element = range.begin; element < range.end; ++element) {
            const std::array<float*, 8> targets = targets_of(range, element, sums);
            const auto& entry = vectors[element].entry;
            for (int i = 0; i < 8; ++i) {
                Eigen::Map<Eigen::Vector4f, Eigen::Aligned16>(targets[i]) +=
                    Eigen::Vector4f(entry[0][i], entry[1][i], entry[2][i], 0);
            }
        }
        return 0.0;
    });
}

}  // namespace tracked_mcf
