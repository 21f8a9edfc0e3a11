// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/kernels/tensor_products.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter_tracked_mcf/core/kernels/tensor_products.cpp"
#include "filter_tracked_mcf/core/kernels/targets.h"

#include "filter_tracked_mcf/core/kernels/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace tracked_mcf::HWY_NAMESPACE {

void add_tensor_products(const TensorBlock* tensors, const TensorProducts& products,
                         std::int64_t begin, std::int64_t end, MatrixBlock* matrices) {
    for (std::int64_t block = begin; block < end; ++block) {
        for (int lane = 0; lane < kBlockElements; lane += kLanes) {
            Lanes tensor[kTensorEntries];
            for (int t = 0; t < kTensorEntries; ++t) {
                tensor[t] = load(tensors[block].entry[t] + lane);
            }
            for (int entry = 0; entry < kMatrixEntries; ++entry) {
                float* const sums = matrices[block].entry[entry] + lane;
                Lanes sum = load(sums);
                for (int t = 0; t < kTensorEntries; ++t) {
                    sum = hn::MulAdd(splat(products.of[t][entry]), tensor[t], sum);
                }
                store(sum, sums);
            }
        }
    }
}

}  // namespace tracked_mcf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
