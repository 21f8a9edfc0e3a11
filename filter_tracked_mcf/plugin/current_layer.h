#pragma once

#include "filter_tracked_mcf/plugin/run_filter.h"
#include "meshlab_api.h"

namespace tracked_mcf {

/// The filter on a document's current layer: run_filter(), then its normals and bounding box. Never
/// throws; a failure leaves the layer as it was.
FilterOutcome smooth_current_layer(MeshDocument& document, const RichParameterList& parameters,
                                   vcg::CallBackPos* callback);

}  // namespace tracked_mcf
