// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/meshlab/legacy/tracked_mcf_plugin.h"

namespace tracked_mcf {

void TrackedMcfPlugin::initParameterSet(QAction* action, MeshDocument& document,
                                        RichParameterList& parameters) {
    parameters = filter(ID(action)).parameters(document.mm());
}

bool TrackedMcfPlugin::applyFilter(QAction* action, MeshDocument& document,
                                   const RichParameterList& parameters,
                                   vcg::CallBackPos* callback) {
    // A call from inside the callback replaces the context, but MeshLab then removes this one.
    MLPluginGLContext* const context = glContext;
    const FilterOutcome outcome = filter(ID(action)).apply(document, parameters, callback);
    glContext = context;
    if (!outcome.succeeded) errorMessage = QString::fromStdString(outcome.message);
    // Of failures, too: meshlabserver does not print errorMessage.
    log_lines(outcome.message, [this](const std::string& line) { Log(line); });
    return outcome.succeeded;
}

}  // namespace tracked_mcf
