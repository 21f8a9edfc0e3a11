// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace tracked_mcf {

/// Returns whether Python runs in this process, as in PyMeshLab. MeshLab has no Python.
bool python_runs();

/// Runs Python's handlers of the signals that have arrived. Returns whether one has raised an
/// exception, as that of Ctrl-C does: then the caller must return to Python, which raises the
/// exception there. Python runs handlers only in its main thread; in others this returns false, as
/// it does without Python.
bool python_interrupts();

}  // namespace tracked_mcf
