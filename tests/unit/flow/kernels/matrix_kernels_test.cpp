// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the kernels for element matrices with plain loops in double.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "filter_tracked_mcf/core/flow/cells/bspline.h"
#include "filter_tracked_mcf/core/flow/kernels/coarsen_elements.h"
#include "filter_tracked_mcf/core/flow/kernels/element_products.h"
#include "filter_tracked_mcf/core/flow/kernels/local_systems.h"
#include "filter_tracked_mcf/core/flow/solver/field.h"
#include "filter_tracked_mcf/core/flow/system/matrix_blocks.h"

namespace tracked_mcf {
namespace {

using Dense = Eigen::MatrixXd;

using Matrix8 = Eigen::Matrix<double, 8, 8>;

/// Elements of a level with random unknowns and matrices. The last block is not full. Elements from
/// the second block on have slots as targets for the first kElsewhere unknowns.
struct RandomElements {
    static constexpr std::int32_t kCount = 2 * kBlockElements + 5;
    static constexpr std::int32_t kUnknowns = 60;
    static constexpr std::int32_t kElsewhere = 20;

    RandomElements() : matrices(kCount) {
        std::vector<std::int32_t> all(kUnknowns);
        std::iota(all.begin(), all.end(), 0);
        for (std::int32_t element = 0; element < kCount; ++element) {
            std::shuffle(all.begin(), all.end(), random);
            unknowns.insert(unknowns.end(), all.begin(), all.begin() + 8);
            for (int i = 0; i < 8; ++i) {
                for (int j = i; j < 8; ++j) matrices.at(element, i, j) = number(random);
            }
        }
        for (auto unknown = unknowns.begin() + 8 * kBlockElements; unknown != unknowns.end();
             ++unknown) {
            targets.push_back(*unknown < kElsewhere ? -1 - *unknown : *unknown);
        }
    }

    ElementRange range(Field& slots) const {
        return {unknowns.data(), target_offsets.data(), targets.data(), slots.data(), 0, kCount};
    }
    Field field() {
        Field result = Field::Zero(4, kUnknowns);
        for (int i = 0; i < kUnknowns; ++i) {
            for (int axis = 0; axis < 3; ++axis) result(axis, i) = number(random);
        }
        return result;
    }
    /// Returns Σ_e R_eᵀ M_e R_e.
    Dense assembled() const {
        Dense sum = Dense::Zero(kUnknowns, kUnknowns);
        for (std::int32_t element = 0; element < kCount; ++element) {
            for (int i = 0; i < 8; ++i) {
                for (int j = 0; j < 8; ++j) {
                    sum(unknowns[8 * element + i], unknowns[8 * element + j]) +=
                        matrices.at(element, i, j);
                }
            }
        }
        return sum;
    }

    std::mt19937 random{5};
    std::uniform_real_distribution<float> number{-1, 1};
    std::vector<std::int32_t> unknowns;
    std::vector<std::int64_t> target_offsets = {ElementRange::kDirect, 0, 8 * kBlockElements};
    std::vector<std::int32_t> targets;
    MatrixBlocks matrices;
};

Dense rows(const Field& field) {
    return field.topRows<3>().transpose().cast<double>();
}

class MatrixKernels : public testing::Test {
protected:
    /// Expects that a kernel added exactly this, slots included.
    void expect_added(const Field& before, const Field& after, const Dense& expected) {
        Field sum = after;
        sum.leftCols<RandomElements::kElsewhere>() += slots_;
        EXPECT_LT((rows(sum) - rows(before) - expected).norm(), 1e-5 * expected.norm());
        EXPECT_TRUE(after.row(3).isZero(0));
        EXPECT_FALSE(slots_.isZero(0));
    }

    RandomElements elements_;
    Field slots_ = Field::Zero(4, RandomElements::kElsewhere);
};

TEST_F(MatrixKernels, ProductsEqualThoseOfTheAssembledMatrix) {
    const Field x = elements_.field();
    const Field before = elements_.field();
    Field y = before;
    add_element_products(elements_.range(slots_), elements_.matrices.blocks(), -0.5F, x.data(),
                         y.data());
    expect_added(before, y, -0.5 * elements_.assembled() * rows(x));
}

TEST_F(MatrixKernels, ProductsOfALastBlockWithoutSlots) {
    elements_.target_offsets.back() = ElementRange::kDirect;
    const Field x = elements_.field();
    Field y = Field::Zero(4, RandomElements::kUnknowns);
    add_element_products(elements_.range(slots_), elements_.matrices.blocks(), 1, x.data(),
                         y.data());
    expect_added(Field::Zero(4, x.cols()), y, elements_.assembled() * rows(x));
}

TEST_F(MatrixKernels, ProductsOfRangesSumToThatOfTheWhole) {
    const Field x = elements_.field();
    Field y = Field::Zero(4, RandomElements::kUnknowns);
    for (std::int32_t begin = 0; begin < RandomElements::kCount; begin += kBlockElements) {
        ElementRange range = elements_.range(slots_);
        range.begin = begin;
        range.end = std::min(begin + kBlockElements, RandomElements::kCount);
        add_element_products(range, elements_.matrices.blocks(), 1, x.data(), y.data());
    }
    expect_added(Field::Zero(4, x.cols()), y, elements_.assembled() * rows(x));
}

Matrix8 whole(const MatrixBlocks& matrices, std::int64_t element) {
    const ElementMatrix matrix = matrices.of(element);
    return Eigen::Map<const Eigen::Matrix<float, 8, 8>>(matrix.entry[0]).cast<double>();
}

/// Returns matrices of NaN, all of which a kernel must overwrite.
MatrixBlocks unset(std::int64_t count) {
    MatrixBlocks matrices(count);
    MatrixBlock nothing;
    std::fill_n(nothing.entry[0], kMatrixEntries * kBlockElements,
                std::numeric_limits<float>::quiet_NaN());
    std::fill_n(matrices.blocks(), matrices.block_count(), nothing);
    return matrices;
}

/// Expects that the matrices of the last block that belong to no element are zero.
void expect_zero_padding(const MatrixBlocks& matrices) {
    for (std::int64_t lane = matrices.size(); lane < kBlockElements * matrices.block_count();
         ++lane) {
        EXPECT_TRUE(whole(matrices, lane).isZero(0));
    }
}

TEST_F(MatrixKernels, AParentsMatrixIsTheSumOverItsChildren) {
    // Every parent has one or two children, and two children are out of order.
    constexpr std::int32_t parents = 19;
    std::vector<std::uint64_t> cells(RandomElements::kCount);
    for (std::uint64_t& cell : cells) cell = elements_.random();
    std::vector<std::int32_t> children(RandomElements::kCount);
    std::iota(children.begin(), children.end(), 0);
    std::swap(children[3], children[30]);
    std::vector<std::int64_t> begins;
    for (std::int64_t parent = 0; parent <= parents; ++parent) {
        begins.push_back(parent * RandomElements::kCount / parents);
    }
    MatrixBlocks sums = unset(parents);
    const ChildElements elements = {elements_.matrices.blocks(), cells.data(), children.data(),
                                    begins.data()};
    coarsen_elements(elements, 0, kBlockElements, sums.blocks());
    coarsen_elements(elements, kBlockElements, parents, sums.blocks());
    for (std::int32_t parent = 0; parent < parents; ++parent) {
        Matrix8 expected = Matrix8::Zero();
        for (std::int64_t k = begins[parent]; k < begins[parent + 1]; ++k) {
            const Matrix8 p = refinement_weights(static_cast<int>(cells[children[k]] % 8));
            expected += p.transpose() * whole(elements_.matrices, children[k]) * p;
        }
        EXPECT_LT((whole(sums, parent) - expected).norm(), 1e-5 * expected.norm());
    }
    expect_zero_padding(sums);
}

TEST_F(MatrixKernels, ALocalInverseWithoutSharedUnknownsIsTheElementsInverse) {
    std::vector<float> damping;
    std::iota(elements_.unknowns.begin(), elements_.unknowns.end(), 0);
    for (std::int32_t element = 0; element < RandomElements::kCount; ++element) {
        damping.push_back(0.1F + elements_.number(elements_.random) / 20);
        for (int i = 0; i < 8; ++i) elements_.matrices.at(element, i, i) += 10;
    }
    // Every other element has entries without a place, which changes nothing.
    std::vector<std::uint32_t> without_place(RandomElements::kCount, 0);
    for (std::size_t i = 0; i < without_place.size(); i += 2) without_place[i] = 0x0F5A5A5A;
    std::vector<Couplings> couplings(elements_.unknowns.size(), Couplings{});
    MatrixBlocks inverses = unset(RandomElements::kCount);
    const CoupledElements range = {elements_.unknowns.data(), without_place.data(), 0,
                                   RandomElements::kCount};
    sum_couplings(range, elements_.matrices.blocks(), couplings.data());
    invert_locally(range, elements_.matrices.blocks(), couplings.data(), damping.data(),
                   inverses.blocks());
    for (std::int32_t element = 0; element < RandomElements::kCount; ++element) {
        const Matrix8 product = whole(inverses, element) * whole(elements_.matrices, element);
        EXPECT_LT((product - damping[element] * Matrix8::Identity()).norm(), 1e-5);
    }
    expect_zero_padding(inverses);
}

}  // namespace
}  // namespace tracked_mcf
