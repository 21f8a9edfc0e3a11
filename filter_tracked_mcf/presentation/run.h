// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/core/fair.h"
#include "filter_tracked_mcf/core/remove_noise.h"

namespace tracked_mcf {

/// Applies the filter of these parameters. See evolve().
inline FlowReport run(TriangleMesh& mesh, const Inputs& inputs, const FlowParameters& parameters,
                      const Progress& progress, const StepObserver& on_step = {}) {
    return evolve(mesh, inputs, parameters, progress, on_step);
}

/// Applies the filter of these parameters, which has no steps to observe. See remove_noise().
inline NoiseReport run(TriangleMesh& mesh, const Inputs& inputs, const NoiseParameters& parameters,
                       const Progress& progress, const StepObserver& /*on_step*/ = {}) {
    return remove_noise(mesh, inputs, parameters, progress);
}

/// Applies the filter of these parameters, which has no steps to observe. See fair().
inline FairReport run(TriangleMesh& mesh, const Inputs& inputs, const FairParameters& parameters,
                      const Progress& progress, const StepObserver& /*on_step*/ = {}) {
    return fair(mesh, inputs.selection, parameters, progress);
}

}  // namespace tracked_mcf
