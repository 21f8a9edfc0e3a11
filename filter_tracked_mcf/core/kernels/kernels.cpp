#include "filter_tracked_mcf/core/kernels/kernels.h"

#include <algorithm>
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
