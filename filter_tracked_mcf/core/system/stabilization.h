// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/elements/tracked_elements.h"
#include "filter_tracked_mcf/core/kernels/tensor_products.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"
#include "filter_tracked_mcf/core/system/matrix_blocks.h"

namespace tracked_mcf {

/// Stabilises the displacement's system by penalising normal derivatives in the volume.
///
/// Grid functions restricted to a surface are nearly dependent: a function that varies only across
/// the surface almost vanishes on it. Such functions keep multigrid and conjugate gradients from
/// converging. The stabilisation adds to the energy of a displacement d its variation along the
/// normals of the initial surface, in the volume of each element's cell:
///
///     κ Σ_elements (δ + 0.1 ρ) ∫_cell ∇dᵀ N ∇d dV,
///
/// in grid units, with the element's density ρ (densities.h; 1 if there are none) and normal tensor
/// N. This is the normal-gradient volume stabilisation of trace finite elements (Burman, Hansbo,
/// Larson and Massing 2018; Grande, Lehrenfeld and Reusken 2018). It applies to the displacement
/// only, so a surface at rest stays at rest.
///
/// N = (λ₁ - λ₂) v vᵀ, where λ₁ >= λ₂ are the largest eigenvalues of ∫ n nᵀ over the element's
/// surface and v is the eigenvector of λ₁. N grows with the area, fades where normals disagree, and
/// does not depend on the orientation of faces.
class Stabilization {
public:
    /// Measures the normal tensors, 24 bytes per element. `elements` must outlive this.
    explicit Stabilization(const TrackedElements& elements);

    /// Adds the stabilisation of weight κ, for the step size δ in squared sides of a cell, to the
    /// finest level's element matrices. Does nothing if κ is 0.
    void add(double weight, double step_size_in_cells, MatrixBlocks& matrices) const;

private:
    const std::vector<float>& densities_;
    RawVector<TensorBlock> normal_tensors_;
};

}  // namespace tracked_mcf
