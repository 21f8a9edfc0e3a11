// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/core/progress.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Smooths `mesh`, or only its selected triangles, by mean-curvature flow with tracked octree
/// finite elements. This is the only call that a host makes.
///
/// Positions are written at the very end, after all steps have succeeded and the last call of
/// `progress` has returned true. Vertices that do not move keep their bits: constrained ones, and
/// those that no selected triangle uses. If nothing is left to do, the flow ends before its last
/// step and FlowReport::stop says why.
///
/// Throws InvalidMesh, InvalidParameter, NotEnoughMemory or Cancelled (errors.h)
/// and leaves the mesh unchanged.
FlowReport evolve(TriangleMesh& mesh, const Selection& selection, const FlowParameters& parameters,
                  const Progress& progress = {});

/// Returns the detail size that a flow of these triangles takes by default, see
/// FlowParameters::detail_size.
double default_detail_size(const TriangleMesh& mesh, const Selection& selection = {});

/// Smooths all of the mesh.
FlowReport evolve(TriangleMesh& mesh, const FlowParameters& parameters,
                  const Progress& progress = {});

}  // namespace tracked_mcf
