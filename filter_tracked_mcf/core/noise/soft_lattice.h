// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "filter_tracked_mcf/core/noise/lattice.h"

namespace tracked_mcf {

/// Returns the lattice along the axes of a part that marching cubes made of a label after it was
/// averaged or blurred, or none.
///
/// Marching cubes prove themselves: each vertex has two whole coordinates, and each triangle is
/// inside a cube. The vertices' third coordinates tell what the cubes had at their corners. Those
/// of a label are at few fractions of a side, and those of a smooth field at all of them.
std::optional<Lattice> soft_lattice_of(const NoisySurface& surface, const PartRange& part);

/// Returns whether marching cubes with the cells of a lattice made a part.
bool is_soft_border(const NoisySurface& surface, const PartRange& part, const Lattice& lattice);

}  // namespace tracked_mcf
