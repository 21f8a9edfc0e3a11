// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/core/progress.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// A callback that receives, after each step, its number, counted from 1, and the positions of all
/// vertices. An exception of the callback propagates to the caller.
///
/// The numbers may exceed FlowReport::steps by 1: a last step that has made the surface vanish is
/// undone.
using StepObserver = std::function<void(int step, const std::vector<Eigen::Vector3d>& positions)>;

/// Smooths `mesh`, or only its selected triangles, by mean-curvature flow with tracked octree
/// finite elements. Hosts call this and default_detail_size().
///
/// Positions are written at the very end, after all steps have succeeded and the last call of
/// `progress` has returned true. Vertices that do not move keep their bits: held ones, and
/// those that no selected triangle uses. If the flow ends before its last step,
/// FlowReport::stop says why.
///
/// Throws InvalidMesh, InvalidParameter, NotEnoughMemory or Cancelled (errors.h)
/// and leaves the mesh unchanged.
FlowReport evolve(TriangleMesh& mesh, const Inputs& inputs, const FlowParameters& parameters,
                  const Progress& progress = {}, const StepObserver& on_step = {});

/// Returns the detail size that a flow of these triangles takes by default, up to rounding, see
/// FlowParameters::detail_size. It is that of another mean edge where only some triangles have
/// copies, which count here, or strength 0. Throws InvalidMesh.
double default_detail_size(const TriangleMesh& mesh, const Selection& selection = {});

/// Smooths all of the mesh.
FlowReport evolve(TriangleMesh& mesh, const FlowParameters& parameters,
                  const Progress& progress = {});

}  // namespace tracked_mcf
