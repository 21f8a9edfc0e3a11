// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/kernels/element_matrix.h"

namespace tracked_mcf {

/// Number of entries of a symmetric 3×3 tensor: xx, yy, zz, xy, yz, zx.
inline constexpr int kTensorEntries = 6;

/// The tensors of a block of elements, stored like a MatrixBlock.
struct TensorBlock {
    alignas(64) float entry[kTensorEntries][kBlockElements];
};

/// A linear map from tensors to matrices: of[t][entry] is the matrix entry for a tensor whose entry
/// t is 1 and whose other entries are 0.
struct TensorProducts {
    float of[kTensorEntries][kMatrixEntries];
};

/// Adds the matrices of the tensors to `matrices`, for the blocks in [begin, end).
using AddTensorProducts = void(const TensorBlock* tensors, const TensorProducts& products,
                               std::int64_t begin, std::int64_t end, MatrixBlock* matrices);

}  // namespace tracked_mcf
