// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "filter_tracked_mcf/core/flow/kernels/coarsen_elements.h"
#include "filter_tracked_mcf/core/flow/kernels/element_products.h"
#include "filter_tracked_mcf/core/flow/kernels/integrate_elements.h"
#include "filter_tracked_mcf/core/flow/kernels/local_systems.h"

namespace tracked_mcf {

/// The innermost loops. Their sources in this folder are written with Google Highway's vectors and
/// compiled once for each InstructionSet, each time into another namespace, HWY_NAMESPACE. The
/// program chooses one of them at run time.
///
/// To add a kernel, add a header with its signature, a source file, and a member here and in
/// kernels.cpp. A kernel may include only files that define nothing but plain structs and
/// constants: no inline functions except those that compute constants, no templates of the standard
/// library or Eigen, no default member initializers. A compiler need not inline such code, and the
/// linker keeps any one of several copies, perhaps the one that needs AVX2. The test
/// kernel_symbols checks this.
///
/// A kernel calls MulAdd and its relatives where a sum of a product is to be rounded once, if the
/// processor can; compilers fuse nothing on their own. So all compilers give the same bits.
struct Kernels {
    IntegrateElements* integrate_elements;
    AddElementProducts* add_element_products;
    CoarsenElements* coarsen_elements;
    SumCouplings* sum_couplings;
    InvertLocally* invert_locally;
};

/// Instruction sets that the kernels are compiled for. Baseline is that of the rest of the program,
/// and the only one on ARM64 (NEON) and with MSVC. Avx2 means AVX2, FMA and BMI. Baseline
/// on x86-64 and Ssse3 give the same bits; Highway 1.0 has no vectors for the former.
enum class InstructionSet { Baseline, Ssse3, Avx2 };

/// Returns "baseline", "ssse3" or "avx2".
std::string_view name_of(InstructionSet instructions);

/// Returns the instruction sets that this program was built for and this machine supports, the best
/// one last.
std::vector<InstructionSet> available_instruction_sets();

/// Returns the instruction set that the environment variable TRACKED_MCF_INSTRUCTIONS names, or the
/// best available one if the variable is empty or unset. Throws InvalidParameter if the name is
/// unknown or not available, because a measurement with another one would mislead.
InstructionSet choose_instruction_set();

/// Returns the kernels for choose_instruction_set(), which the first call chooses; throws as it
/// does.
const Kernels& kernels();

/// Returns the kernels for an instruction set. Throws InvalidParameter if it is not available.
const Kernels& kernels_for(InstructionSet instructions);

}  // namespace tracked_mcf
