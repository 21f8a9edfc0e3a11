// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/kernels/integrate_elements.h"

namespace tracked_mcf {

/// Computes ∫ B_I n over the embedded surface, for elements begin to end of the input, by their
/// samples. n is the unit normal of the embedded surface, on the side of the triangles' own.
/// `normals` has room for all elements of the level.
using IntegrateNormals = void(const IntegrationInput& input, ElementVector* normals);

}  // namespace tracked_mcf
