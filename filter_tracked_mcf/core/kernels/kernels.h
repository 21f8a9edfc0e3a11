#pragma once

#include "filter_tracked_mcf/core/kernels/instruction_set.h"
#include "filter_tracked_mcf/core/kernels/kernel_table.h"

namespace tracked_mcf {

/// The kernels for choose_instruction_set(), which is asked at the first call; throws as it does.
const Kernels& kernels();

/// The kernels for an available instruction set. Throws InvalidParameter if it is not available.
const Kernels& kernels_for(InstructionSet instructions);

}  // namespace tracked_mcf
