// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/plugin/run_filter.h"
#include "meshlab_api.h"

namespace tracked_mcf {

/// Which build this is: for the filter's help and its lines in MeshLab's log.
inline constexpr const char* kBuild = "Filter Tracked MCF " TRACKED_MCF_VERSION;

/// Returns parameter_table() for MeshLab's dialogs and scripts. `selected` is on if `layer`, which
/// may be null, has selected faces.
RichParameterList rich_parameters(const MeshModel* layer);

/// Runs the filter on the document's current layer and updates the layer's normals and bounding
/// box, and its mask if it has got a quality. Never throws. A failure leaves the layer as it was.
///
/// Fails if this thread runs the filter already, or if `callback`, in which hosts process the
/// user's events, changes or deletes the layer.
FilterOutcome smooth_current_layer(MeshDocument& document, const RichParameterList& parameters,
                                   vcg::CallBackPos* callback);

}  // namespace tracked_mcf
