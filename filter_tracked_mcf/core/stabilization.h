#pragma once

#include "filter_tracked_mcf/core/kernels/tensor_products.h"
#include "filter_tracked_mcf/core/matrix_blocks.h"
#include "filter_tracked_mcf/core/raw_vector.h"
#include "filter_tracked_mcf/core/tracked_elements.h"

namespace tracked_mcf {

/// The stabilisation of the displacement's system by normal derivatives in the volume.
///
/// On a surface, grid functions are nearly dependent: what varies only across the surface can
/// hardly be seen on it, and keeps multigrid and conjugate gradients from converging. So a
/// displacement d pays for varying along the normals of the initial surface, in the volume of
/// every element's cell:
///
///     κ (δ' + 0.1) Σ_elements ∫_cell ∇dᵀ N ∇d dV,
///
/// grid units, δ' the step size, N the element's normal tensor. It is the normal-gradient volume
/// stabilisation of trace finite elements (Burman, Hansbo, Larson and Massing 2018; Grande,
/// Lehrenfeld and Reusken 2018). Only the displacement pays, not the surface itself, so there is
/// nothing to pay at rest.
///
/// N = (λ₁ - λ₂) v vᵀ, with λ₁ >= λ₂ the largest eigenvalues of ∫ n nᵀ over the element's surface
/// and v the eigenvector of the first: an element pays by its area, less where its normals
/// disagree, and it does not matter which way faces are oriented.
class Stabilization {
public:
    /// Measures the normal tensors; 24 bytes an element.
    explicit Stabilization(const TrackedElements& elements);

    /// Adds the stabilisation with weight κ for the step size δ' (grid units) to the finest level's
    /// element matrices; nothing if κ is 0.
    void add(double weight, double step_size, MatrixBlocks& matrices) const;

private:
    RawVector<TensorBlock> normal_tensors_;
};

}  // namespace tracked_mcf
