// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <utility>

#include "filter_tracked_mcf/core/flow/stepper.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/plan/plan.h"

namespace tracked_mcf {

/// Plans a flow of a whole mesh, on a grid or on the one that the parameters choose.
inline Plan plan_of(const TriangleMesh& mesh, const FlowParameters& parameters,
                    const std::optional<Grid>& grid = {}) {
    if (!grid) return plan_of(mesh, {}, parameters);
    Domain domain(mesh, parameters.boundary);
    ClippedSurface surface = clip_to_grid(domain.surface(), *grid);
    return plan_of(std::move(domain), std::move(surface), mean_edge_length(mesh), parameters);
}

inline Stepper stepper_of(Plan plan) {
    return {build_tracked_elements(plan.domain, std::move(plan.surface), plan.discretisation,
                                   plan.densities),
            plan.steps};
}

}  // namespace tracked_mcf
