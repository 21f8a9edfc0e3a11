// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>

#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Returns the filter's parameters from all keyword arguments of its function. A length in per cent
/// becomes one in units of the mesh. Throws InvalidParameter for a value that is refused, and
/// nanobind::type_error for a wrong type.
template <class Parameters>
Parameters parameters_of(const nanobind::dict& given, const TriangleMesh& mesh);

/// Returns a list of the filter's parameters, a dictionary for each:
/// - `name`, `help`, and `type` and `default` as in the function's signature;
/// - `choices`, a pair for each choice in their order: PyMeshLab's name, and that of the function;
/// - `label` in dialogs, which is empty if PyMeshLab does not offer the parameter;
/// - `of_faces` only for an input: whether it has a number for each face, else for each vertex.
template <class Parameters>
nanobind::list described_parameters();

}  // namespace tracked_mcf
