// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/hosts/host.h"

#include <iterator>
#include <stdexcept>

#include "release.h"

namespace tracked_mcf::host {

struct Filter::Loaded {
    Loaded(const std::string& file, const std::string& name) : plugin(file) {
        for (QAction* candidate : plugin.filters().actions()) {
            const bool wanted = name.empty() || candidate->text().toStdString() == name;
            if (wanted && action == nullptr) action = candidate;
        }
        if (action == nullptr) throw std::runtime_error("No filter " + name + " in " + file);
    }

    PluginFile plugin;
    QAction* action = nullptr;
};

Filter::Filter(const std::string& plugin_file, const std::string& name)
    : loaded_(std::make_unique<Loaded>(plugin_file, name)) {}

Filter::~Filter() = default;

Declaration Filter::declaration() const {
    FilterInterface& filters = loaded_->plugin.filters();
    QAction* const action = loaded_->action;
    return {action->text().toStdString(),
            python_name(filters, action),
            filters.filterInfo(action).toStdString(),
            built_for(filters),
            filters.getClass(action) == FilterInterface::Smoothing,
            filters.filterArity(action) == FilterInterface::SINGLE_MESH,
            filters.getRequirements(action),
            filters.postCondition(action)};
}

std::ptrdiff_t Filter::filters_in_plugin() const {
    const auto actions = loaded_->plugin.filters().actions();  // a QList or a std::list
    return std::distance(actions.begin(), actions.end());
}

bool Filter::is_applicable(const MeshModel& layer) const {
    QStringList missing;
    return loaded_->plugin.filters().isFilterApplicable(loaded_->action, layer, missing);
}

RichParameterList Filter::parameters(MeshDocument& document) const {
    return parameters_of(loaded_->plugin.filters(), loaded_->action, document);
}

Outcome Filter::apply(MeshDocument& document, const RichParameterList& parameters,
                      vcg::CallBackPos* callback) const {
    FilterInterface& filters = loaded_->plugin.filters();
    if (document.mm() != nullptr) {
        document.mm()->updateDataMask(filters.getRequirements(loaded_->action));
    }
    GLLogStream log;
    filters.setLog(&log);
    Outcome outcome{};
    run(filters, loaded_->action, document, parameters, callback, outcome);
    filters.setLog(nullptr);
    QStringList lines;
    log.print(lines);
    outcome.log = lines.join("\n").toStdString();
    return outcome;
}

void set_length(RichParameterList& parameters, const QString& name, float length) {
    const std::unique_ptr<Value> value(parameters.getParameterByName(name).value().clone());
    value->set(FloatValue(length));
    parameters.setValue(name, *value);
}

}  // namespace tracked_mcf::host
