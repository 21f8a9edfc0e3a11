#pragma once

#include <string_view>
#include <vector>

namespace tracked_mcf {

/// What the kernels are compiled for. Baseline is what the rest of the program is compiled for.
/// Avx2 means AVX2 and FMA; Avx512 besides these F, VL, DQ and BW.
enum class InstructionSet { Baseline, Avx2, Avx512 };

/// "baseline", "avx2" or "avx512".
std::string_view name_of(InstructionSet instructions);

/// Those that this program was built with and that processor and system offer, the best one last.
std::vector<InstructionSet> available_instruction_sets();

/// The best available one, unless the environment variable TRACKED_MCF_INSTRUCTIONS names another.
/// Throws InvalidParameter if it names none, or one that is not available: who sets it wants to
/// measure or to compare, and would be misled by anything else.
InstructionSet choose_instruction_set();

}  // namespace tracked_mcf
