// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tracked_mcf {

/// Returns whether Python runs in this process, as in PyMeshLab. MeshLab has no Python.
bool python_runs();

}  // namespace tracked_mcf
