#pragma once

#include "filter_tracked_mcf/core/kernels/coarsen_elements.h"
#include "filter_tracked_mcf/core/kernels/element_products.h"
#include "filter_tracked_mcf/core/kernels/integrate_elements.h"
#include "filter_tracked_mcf/core/kernels/local_systems.h"
#include "filter_tracked_mcf/core/kernels/tensor_products.h"

namespace tracked_mcf {

/// The innermost loops. The sources of this folder that define them, and kernel_table.cpp, are
/// compiled once for every InstructionSet, each time into a namespace of its own, which
/// TRACKED_MCF_KERNELS names; the processor's is chosen at run time.
///
/// A kernel has a header with its signature, a source file, a member here, and a line in
/// kernel_table.cpp. What kernels include must not define anything but plain structs and constants:
/// no inline functions but to make constants, no templates of the standard library or Eigen, no
/// default member initializers. Compilers need not inline those, and of several copies of one the
/// linker keeps any, perhaps the one that needs AVX-512. The test kernel_symbols watches over it.
struct Kernels {
    IntegrateElements* integrate_elements;
    AddElementProducts* add_element_products;
    AddElementProductsAndDot* add_element_products_and_dot;
    AddElementVectors* add_element_vectors;
    CoarsenElements* coarsen_elements;
    SumCouplings* sum_couplings;
    InvertLocally* invert_locally;
    AddTensorProducts* add_tensor_products;
};

}  // namespace tracked_mcf
