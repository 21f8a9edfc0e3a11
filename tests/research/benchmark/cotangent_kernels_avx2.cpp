// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/research/benchmark/cotangent_kernels.h"

namespace tracked_mcf::benchmark::avx2 {

namespace {
#include "tests/research/benchmark/cotangent_kernels.inc"
}  // namespace

extern const CotangentKernels kKernels;
const CotangentKernels kKernels = {"avx2", assemble, factorize, multiply, forward, backward};

}  // namespace tracked_mcf::benchmark::avx2
