// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Chooses the instruction sets that Highway compiles the kernels for. A source of kernels defines
// HWY_TARGET_INCLUDE as its own path, then includes this file: Highway includes the source again
// for each instruction set but the compiler's own.

#include <hwy/detect_compiler_arch.h>

// SSE4 and all kinds of AVX-512, whose bits are lower than that of AVX2, are not faster here.
#define HWY_DISABLED_TARGETS (HWY_SSE4 | (HWY_AVX2 - 1))

// ARM64's own set has vectors. Which sets an x86 processor has, kernels.cpp asks GCC and Clang.
#if !HWY_ARCH_X86 || HWY_COMPILER_MSVC
#define HWY_COMPILE_ONLY_STATIC
#define TOOLCHAIN_MISS_SYS_AUXV_H  // or Highway 1.0 asks for ARM64's cryptography
#endif

// Highway takes the set without vectors, SCALAR, for compilers that translate some products of
// 16-bit integers in EMU128 wrongly. The kernels have none, and need vectors of four floats.
#define HWY_BROKEN_EMU128 0

// Highway's checks of arguments would call its library; the headers suffice otherwise.
#define HWY_IS_DEBUG_BUILD 0

#include <hwy/foreach_target.h>
