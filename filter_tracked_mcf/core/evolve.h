#pragma once

#include "filter_tracked_mcf/core/domain.h"
#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/core/progress.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

class ProgressMeter;

/// Smooths `mesh`, or only its selected triangles, by mean-curvature flow with tracked octree
/// finite elements: the one call that hosts make. Positions are written only after the last step
/// has succeeded and the last call of `progress` has not objected; vertices that do not move, those
/// that are held or that no selected triangle uses among them, keep their bits. A flow that has
/// nothing left to do ends before its last step, as FlowReport::stop says.
///
/// Throws InvalidMesh, InvalidParameter, NotEnoughMemory, NumericalFailure or Cancelled (errors.h),
/// leaving the mesh as it was.
FlowReport evolve(TriangleMesh& mesh, const Selection& selection, const FlowParameters& parameters,
                  const Progress& progress = {});

/// The same, reporting to a meter that the calling thread has made for this (progress_meter.h).
FlowReport evolve(TriangleMesh& mesh, const Selection& selection, const FlowParameters& parameters,
                  ProgressMeter& meter);

/// The same for all of the mesh.
FlowReport evolve(TriangleMesh& mesh, const FlowParameters& parameters,
                  const Progress& progress = {});

}  // namespace tracked_mcf
