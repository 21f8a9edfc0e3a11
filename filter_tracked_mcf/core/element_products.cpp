#include "filter_tracked_mcf/core/element_products.h"

#include "filter_tracked_mcf/core/kernels/kernels.h"
#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

namespace {

ElementRange range(const Level& level, const std::vector<ElementMatrix>& matrices,
                   std::int32_t begin, std::int32_t end) {
    return {matrices.data(), level.unknowns.front().data(), begin, end};
}

}  // namespace

void add_products(const Level& level, const ElementBlocks& blocks,
                  const std::vector<ElementMatrix>& matrices, float factor, const Field& x,
                  Field& y) {
    blocks.for_each([&](std::int32_t begin, std::int32_t end) {
        kernels().add_element_products(range(level, matrices, begin, end), factor, x.data(),
                                       y.data());
    });
}

void subtract_products(const Level& level, const ElementBlocks& blocks,
                       const std::vector<ElementMatrix>& matrices, const Field& right_side,
                       const Field& x, Field& residual) {
    copy(right_side, residual);
    add_products(level, blocks, matrices, -1, x, residual);
}

void subtract_products(const Level& level, const ElementBlocks& blocks,
                       const std::vector<ElementMatrix>& matrices, const Field& right_side,
                       const Coefficients& x, Field& residual) {
    Coefficients sum = right_side.topRows<3>().transpose().cast<double>();
    blocks.for_each([&](std::int32_t begin, std::int32_t end) {
        for (std::int32_t element = begin; element < end; ++element) {
            const auto& unknowns = level.unknowns[element];
            for (int i = 0; i < 8; ++i) {
                Eigen::RowVector3d product = Eigen::RowVector3d::Zero();
                for (int j = 0; j < 8; ++j) {
                    product += matrices[element].entry[i][j] * x.row(unknowns[j]);
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

double multiply(const Level& level, const ElementBlocks& blocks,
                const std::vector<ElementMatrix>& matrices, const Field& x, Field& y) {
    set_zero(y, level.unknown_count());
    return blocks.sum([&](std::int32_t begin, std::int32_t end) {
        return kernels().add_element_products_and_dot(range(level, matrices, begin, end), x.data(),
                                                      y.data());
    });
}

void sum_vectors(const Level& level, const ElementBlocks& blocks,
                 const std::vector<ElementVector>& vectors, Field& sum) {
    set_zero(sum, level.unknown_count());
    blocks.for_each([&](std::int32_t begin, std::int32_t end) {
        kernels().add_element_vectors({vectors.data(), level.unknowns.front().data(), begin, end},
                                      sum.data());
    });
}

}  // namespace tracked_mcf
