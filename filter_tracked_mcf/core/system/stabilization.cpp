// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/system/stabilization.h"

#include <Eigen/Eigenvalues>
#include <array>

#include "filter_tracked_mcf/core/cells/bspline.h"
#include "filter_tracked_mcf/core/kernels/kernels.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// Added to δ, times the density, so that the stabilisation does not vanish beside the mass matrix
/// at small steps.
constexpr double kMassShare = 0.1;

/// Integrals over [0, 1] of products of two hat functions, values or slopes.
constexpr double kValueValue[2][2] = {{1.0 / 3, 1.0 / 6}, {1.0 / 6, 1.0 / 3}};
constexpr double kSlopeSlope[2][2] = {{1, -1}, {-1, 1}};
constexpr double kSlopeValue[2][2] = {{-0.5, -0.5}, {0.5, 0.5}};

/// Returns ∫_cell ∂_a B_I ∂_b B_J dV for I = `row`, J = `column`.
double gradient_product(int row, int column, int a, int b) {
    double product = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const int i = corner_bit(row, axis), j = corner_bit(column, axis);
        if (axis == a && axis == b) {
            product *= kSlopeSlope[i][j];
        } else if (axis == a) {
            product *= kSlopeValue[i][j];
        } else if (axis == b) {
            product *= kSlopeValue[j][i];
        } else {
            product *= kValueValue[i][j];
        }
    }
    return product;
}

/// The two axes of each entry of a stored tensor.
constexpr std::array<std::array<int, 2>, kTensorEntries> kEntries = {
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}}};

/// Returns the coefficients of N's entries in factor * ∫_cell ∇B_Iᵀ N ∇B_J dV.
TensorProducts tensor_products(double factor) {
    TensorProducts products;
    for (std::size_t entry = 0; entry < kEntries.size(); ++entry) {
        const auto [a, b] = kEntries[entry];
        for (int row = 0; row < 8; ++row) {
            for (int column = row; column < 8; ++column) {
                double sum = gradient_product(row, column, a, b);
                if (a != b) sum += gradient_product(row, column, b, a);
                products.of[entry][kEntryIndices.of[row][column]] =
                    static_cast<float>(factor * sum);
            }
        }
    }
    return products;
}

/// Returns ∫ n nᵀ over the element's surface, which does not depend on the orientation of faces.
Eigen::Matrix3d normal_product(const TrackedElements& elements, std::int64_t element) {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    std::int64_t sample = elements.sample_begin[element];
    for (std::int64_t i = elements.fragment_begin[element];
         i < elements.fragment_begin[element + 1]; ++i) {
        const Fragment& fragment = elements.fragments[i];
        double weight = 0;
        for (std::int32_t k = 0; k < fragment.sample_count; ++k) {
            weight += elements.samples.weight(sample++);
        }
        const Eigen::Vector3d normal(fragment.normal[0], fragment.normal[1], fragment.normal[2]);
        sum += weight * normal * normal.transpose();
    }
    return sum;
}

/// Returns N: the dominant direction of the normals, weighted by the gap of the eigenvalues.
Eigen::Matrix3d normal_tensor(const Eigen::Matrix3d& normal_product) {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
    eigen.computeDirect(normal_product);
    const Eigen::Vector3d direction = eigen.eigenvectors().col(2);
    const double gap = eigen.eigenvalues()[2] - eigen.eigenvalues()[1];
    return gap * direction * direction.transpose();
}

}  // namespace

Stabilization::Stabilization(const TrackedElements& elements) : densities_(elements.densities) {
    const std::int64_t count = elements.finest().element_count();
    normal_tensors_.resize(static_cast<std::size_t>((count + kBlockElements - 1) / kBlockElements));
    if (count > 0) normal_tensors_.back() = TensorBlock{};
    parallel_for_chunks(count, [&](std::int64_t begin, std::int64_t end) {
        Pacer pacer;
        for (std::int64_t element = begin; element < end; ++element) {
            const Eigen::Matrix3d tensor = normal_tensor(normal_product(elements, element));
            TensorBlock& block = normal_tensors_[element / kBlockElements];
            for (std::size_t entry = 0; entry < kEntries.size(); ++entry) {
                const auto [row, column] = kEntries[entry];
                block.entry[entry][element % kBlockElements] =
                    static_cast<float>(tensor(row, column));
            }
            pacer.did(elements.sample_begin[element + 1] - elements.sample_begin[element]);
        }
    });
}

void Stabilization::add(double weight, double step_size_in_cells, MatrixBlocks& matrices) const {
    if (weight == 0) return;
    const double factor = step_size_in_cells + kMassShare;
    const TensorProducts products = tensor_products(weight * factor);
    RawVector<TensorBlock> scaled;
    if (!densities_.empty()) {
        scaled = normal_tensors_;
        parallel_for_rows(matrices.size(), [&](std::int32_t element) {
            const double own = step_size_in_cells + kMassShare * double{densities_[element]};
            for (auto& entry : scaled[element / kBlockElements].entry)
                entry[element % kBlockElements] *= static_cast<float>(own / factor);
        });
    }
    const RawVector<TensorBlock>& tensors = densities_.empty() ? normal_tensors_ : scaled;
    parallel_for_chunks(matrices.size(), [&](std::int64_t begin, std::int64_t end) {
        kernels().add_tensor_products(tensors.data(), products, begin / kBlockElements,
                                      (end + kBlockElements - 1) / kBlockElements,
                                      matrices.blocks());
    });
}

}  // namespace tracked_mcf
