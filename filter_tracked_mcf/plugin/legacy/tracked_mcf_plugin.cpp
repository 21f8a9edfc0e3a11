// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/plugin/legacy/tracked_mcf_plugin.h"

namespace tracked_mcf {

void TrackedMcfPlugin::initParameterSet(QAction*, MeshDocument& document,
                                        RichParameterList& parameters) {
    parameters = rich_parameters(document.mm());
}

bool TrackedMcfPlugin::applyFilter(QAction*, MeshDocument& document,
                                   const RichParameterList& parameters,
                                   vcg::CallBackPos* callback) {
    const FilterOutcome outcome = smooth_current_layer(document, parameters, callback);
    if (!outcome.succeeded) errorMessage = QString::fromStdString(outcome.message);
    // Of failures, too: meshlabserver does not print errorMessage.
    Log(kBuild + (": " + outcome.message));
    return outcome.succeeded;
}

}  // namespace tracked_mcf
