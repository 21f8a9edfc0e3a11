#include "filter_tracked_mcf/core/kernels/kernel_table.h"

namespace tracked_mcf::TRACKED_MCF_KERNELS {

IntegrateElements integrate_elements;
AddElementProducts add_element_products;
AddElementProductsAndDot add_element_products_and_dot;
AddElementVectors add_element_vectors;
CoarsenElements coarsen_elements;
SumCouplings sum_couplings;
InvertLocally invert_locally;
AddTensorProducts add_tensor_products;

extern const Kernels kTable = {
    integrate_elements,  add_element_products, add_element_products_and_dot,
    add_element_vectors, coarsen_elements,     sum_couplings,
    invert_locally,      add_tensor_products};

}  // namespace tracked_mcf::TRACKED_MCF_KERNELS
