// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/research/benchmark/cotangent_kernels.h"

namespace tracked_mcf::benchmark::baseline {

namespace {
#include "tests/research/benchmark/cotangent_kernels.inc"
}  // namespace

extern const CotangentKernels kKernels;
const CotangentKernels kKernels = {"baseline", assemble, factorize, multiply, forward, backward};

}  // namespace tracked_mcf::benchmark::baseline
