#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/element_matrix.h"

namespace tracked_mcf {

/// Entries of a symmetric 3×3 tensor: xx, yy, zz, xy, yz, zx.
inline constexpr int kTensorEntries = 6;

/// A tensor for each element of a MatrixBlock, side by side likewise.
struct TensorBlock {
    alignas(64) float entry[kTensorEntries][kBlockElements];
};

/// What each entry of an element's tensor, if it is 1, contributes to each of its matrix.
struct TensorProducts {
    float of[kTensorEntries][kMatrixEntries];
};

/// Adds to the matrices of the blocks from `begin` to `end` what their tensors contribute.
using AddTensorProducts = void(const TensorBlock* tensors, const TensorProducts& products,
                               std::int64_t begin, std::int64_t end, MatrixBlock* matrices);

}  // namespace tracked_mcf
