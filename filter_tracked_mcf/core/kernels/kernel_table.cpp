#include "filter_tracked_mcf/core/kernels/kernel_table.h"

namespace tracked_mcf::TRACKED_MCF_KERNELS {

IntegrateElement integrate_element;

extern const Kernels kTable;
const Kernels kTable = {integrate_element};

}  // namespace tracked_mcf::TRACKED_MCF_KERNELS
