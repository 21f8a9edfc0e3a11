// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/research/benchmark/cotangent_kernels.h"

#include <cstdlib>
#include <cstring>

namespace tracked_mcf::benchmark {

namespace baseline {
extern const CotangentKernels kKernels;
}

#ifdef TRACKED_MCF_WITH_AVX2

namespace avx2 {
extern const CotangentKernels kKernels;
}

const CotangentKernels& cotangent_kernels() {
    const char* const wish = std::getenv("TRACKED_MCF_INSTRUCTIONS");
    const bool baseline_only = wish != nullptr && std::strcmp(wish, "baseline") == 0;
    const bool has_avx2 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
    return has_avx2 && !baseline_only ? avx2::kKernels : baseline::kKernels;
}

#else

const CotangentKernels& cotangent_kernels() {
    return baseline::kKernels;
}

#endif

}  // namespace tracked_mcf::benchmark
