#pragma once

#include "filter_tracked_mcf/plugin/parameter_values.h"
#include "meshlab_api.h"

namespace tracked_mcf {

/// parameter_table() as MeshLab's dialogs and scripts know it. `layer`, which may be null, is the
/// one that is smoothed: where it has selected faces, `selected` is on.
RichParameterList rich_parameters(const MeshModel* layer);

/// What a dialog or script gives for the parameters of the table. What is absent or has another
/// type is left out, for flow_parameters() to complain of: MeshLab's own getters would end the
/// program.
ParameterValues read_values(const RichParameterList& list);

}  // namespace tracked_mcf
