#include "filter_tracked_mcf/core/kernels/kernel_table.h"

namespace tracked_mcf::TRACKED_MCF_KERNELS {

IntegrateElements integrate_elements;

extern const Kernels kTable;
const Kernels kTable = {integrate_elements};

}  // namespace tracked_mcf::TRACKED_MCF_KERNELS
