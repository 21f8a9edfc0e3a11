// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/kernels/kernels.h"

namespace tracked_mcf::TRACKED_MCF_KERNELS {

IntegrateElements integrate_elements;
IntegrateNormals integrate_normals;
AddElementProducts add_element_products;
AddElementProductsAndDot add_element_products_and_dot;
CoarsenElements coarsen_elements;
SumCouplings sum_couplings;
InvertLocally invert_locally;
AddTensorProducts add_tensor_products;

extern const Kernels kTable = {
    integrate_elements, integrate_normals, add_element_products, add_element_products_and_dot,
    coarsen_elements,   sum_couplings,     invert_locally,       add_tensor_products};

}  // namespace tracked_mcf::TRACKED_MCF_KERNELS
