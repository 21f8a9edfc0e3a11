// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/meshlab/modern/tracked_mcf_plugin.h"

namespace tracked_mcf {

RichParameterList TrackedMcfPlugin::initParameterList(const QAction* action,
                                                      const MeshDocument& document) {
    return filter(ID(action)).parameters(document.mm());
}

std::map<std::string, QVariant> TrackedMcfPlugin::applyFilter(const QAction* action,
                                                              const RichParameterList& parameters,
                                                              MeshDocument& document,
                                                              unsigned int& post_condition_mask,
                                                              vcg::CallBackPos* callback) {
    // A call from inside the callback replaces the context, but MeshLab then removes this one.
    MLPluginGLContext* const context = glContext;
    const FilterOutcome outcome = filter(ID(action)).apply(document, parameters, callback);
    glContext = context;
    // MLException is the only exception that hosts expect.
    if (!outcome.succeeded) throw MLException(QString::fromStdString(outcome.message));
    log_lines(outcome.message, [this](const std::string& line) { log(line); });
    post_condition_mask = static_cast<unsigned int>(postCondition(action));
    std::map<std::string, QVariant> outputs;
    for (const auto& [name, output] : outcome.outputs) {
        outputs[name] = std::visit([](auto number) { return QVariant(number); }, output);
    }
    return outputs;
}

}  // namespace tracked_mcf
