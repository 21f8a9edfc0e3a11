// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/kernels/kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter_tracked_mcf/core/flow/kernels/kernels.cpp"
#include "filter_tracked_mcf/core/flow/kernels/targets.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include "filter_tracked_mcf/core/errors.h"

namespace tracked_mcf::HWY_NAMESPACE {

IntegrateElements integrate_elements;
AddElementProducts add_element_products;
CoarsenElements coarsen_elements;
SumCouplings sum_couplings;
InvertLocally invert_locally;

constexpr Kernels kTable = {integrate_elements, add_element_products, coarsen_elements,
                            sum_couplings, invert_locally};

}  // namespace tracked_mcf::HWY_NAMESPACE

#if HWY_ONCE

namespace tracked_mcf {

namespace {

/// The kernels of an instruction set, or null if they are not compiled for it.
const Kernels* table_of(InstructionSet instructions) {
    constexpr const Kernels* tables[] = {&HWY_STATIC_DISPATCH(kTable), HWY_CHOOSE_SSSE3(kTable),
                                         HWY_CHOOSE_AVX2(kTable)};
    return tables[static_cast<int>(instructions)];
}

/// Returns whether the processor has what Highway uses of an instruction set. The kernels have no
/// cryptography and no half-precision numbers.
bool has(InstructionSet instructions) {
#ifdef HWY_COMPILE_ONLY_STATIC
    return instructions == InstructionSet::Baseline;
#else
    __builtin_cpu_init();
    const bool ssse3 = __builtin_cpu_supports("ssse3") != 0;
    const bool avx2 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
                      __builtin_cpu_supports("bmi") != 0 && __builtin_cpu_supports("bmi2") != 0;
    const bool all[] = {true, ssse3, avx2};
    return all[static_cast<int>(instructions)];
#endif
}

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
    constexpr std::string_view names[] = {"baseline", "ssse3", "avx2"};
    return names[static_cast<int>(instructions)];
}

std::vector<InstructionSet> available_instruction_sets() {
    std::vector<InstructionSet> available = {InstructionSet::Baseline};
    for (const InstructionSet better : {InstructionSet::Ssse3, InstructionSet::Avx2}) {
        const Kernels* const table = table_of(better);
        if (table != nullptr && table != table_of(InstructionSet::Baseline) && has(better)) {
            available.push_back(better);
        }
    }
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
    return *table_of(instructions);
}

const Kernels& kernels() {
    static const Kernels& chosen = kernels_for(choose_instruction_set());
    return chosen;
}

}  // namespace tracked_mcf

#endif  // HWY_ONCE
