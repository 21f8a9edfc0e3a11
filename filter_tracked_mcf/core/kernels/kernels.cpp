// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/kernels/kernels.h"

#include <algorithm>
#include <cstdlib>
#include <string>

#include "filter_tracked_mcf/core/errors.h"

namespace tracked_mcf {

namespace kernels_baseline {
extern const Kernels kTable;
}
#ifdef TRACKED_MCF_X86_64_KERNELS
namespace kernels_avx2 {
extern const Kernels kTable;
}
namespace kernels_avx512 {
extern const Kernels kTable;
}
#endif

namespace {

constexpr const char* kVariable = "TRACKED_MCF_INSTRUCTIONS";

[[noreturn]] void refuse(std::string_view value, const std::vector<InstructionSet>& available) {
    std::string names;
    for (const InstructionSet instructions : available) {
        if (!names.empty()) names += " or ";
        names += name_of(instructions);
    }
    throw InvalidParameter("The environment variable " + std::string(kVariable) + " is \"" +
                           std::string(value) + "\"; this machine has " + names +
                           ". Unset it to use the best.");
}

}  // namespace

std::string_view name_of(InstructionSet instructions) {
    constexpr std::string_view names[] = {"baseline", "avx2", "avx512"};
    return names[static_cast<int>(instructions)];
}

std::vector<InstructionSet> available_instruction_sets() {
    std::vector<InstructionSet> available = {InstructionSet::Baseline};
#ifdef TRACKED_MCF_X86_64_KERNELS
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2") == 0 || __builtin_cpu_supports("fma") == 0) return available;
    available.push_back(InstructionSet::Avx2);
    if (__builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512vl") != 0 &&
        __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512bw") != 0) {
        available.push_back(InstructionSet::Avx512);
    }
#endif
    return available;
}

InstructionSet choose_instruction_set() {
    const std::vector<InstructionSet> available = available_instruction_sets();
    const char* const value = std::getenv(kVariable);
    if (value == nullptr || *value == '\0') return available.back();
    const auto found =
        std::find_if(available.begin(), available.end(),
                     [&](InstructionSet instructions) { return name_of(instructions) == value; });
    if (found == available.end()) refuse(value, available);
    return *found;
}

const Kernels& kernels_for(InstructionSet instructions) {
    const std::vector<InstructionSet> available = available_instruction_sets();
    if (std::find(available.begin(), available.end(), instructions) == available.end()) {
        throw InvalidParameter("This machine does not have " + std::string(name_of(instructions)) +
                               ".");
    }
#ifdef TRACKED_MCF_X86_64_KERNELS
    if (instructions == InstructionSet::Avx512) return kernels_avx512::kTable;
    if (instructions == InstructionSet::Avx2) return kernels_avx2::kTable;
#endif
    return kernels_baseline::kTable;
}

const Kernels& kernels() {
    static const Kernels& chosen = kernels_for(choose_instruction_set());
    return chosen;
}

}  // namespace tracked_mcf
