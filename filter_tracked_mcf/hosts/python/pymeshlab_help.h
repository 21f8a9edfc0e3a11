// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace tracked_mcf {

/// Returns the docstring of the filter's method in PyMeshLab, from the table of its parameters.
template <class Parameters>
std::string pymeshlab_help();

}  // namespace tracked_mcf
