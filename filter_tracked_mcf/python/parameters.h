// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <nanobind/nanobind.h>

#include <string>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Returns the flow's parameters from the keyword arguments of smooth(). The others have their
/// defaults, and a length in per cent becomes one in units of the mesh. Throws InvalidParameter for
/// a value that is refused, and nanobind::type_error for an unknown name or a wrong type.
FlowParameters flow_parameters(const nanobind::kwargs& given, const TriangleMesh& mesh);

/// Returns the signature of smooth() in Python, with the type and the default of each parameter.
std::string signature_of_smooth();

/// Returns what each keyword parameter means, one paragraph each.
std::string help_of_parameters();

/// Returns a list of the parameters that PyMeshLab offers, a dictionary for each:
/// - `name`, and `type`, a word;
/// - `choices`, which maps PyMeshLab's name of each choice to that of smooth(), in their order.
nanobind::list pymeshlab_parameters();

}  // namespace tracked_mcf
