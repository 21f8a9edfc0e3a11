// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Returns the flow's parameters from all keyword arguments of smooth(). A length in per cent
/// becomes one in units of the mesh. Throws InvalidParameter for a value that is refused, and
/// nanobind::type_error for a wrong type.
FlowParameters flow_parameters(const nanobind::dict& given, const TriangleMesh& mesh);

/// Returns a list of the parameters, a dictionary for each:
/// - `name`, `help`, and `type` and `default` as in the signature of smooth();
/// - `choices`, a pair for each choice in their order: PyMeshLab's name, and that of smooth();
/// - `label` in dialogs, which is empty if PyMeshLab does not offer the parameter.
nanobind::list parameters();

}  // namespace tracked_mcf
