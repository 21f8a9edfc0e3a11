#include "tests/hosts/host.h"

#include <common/plugins/plugin_manager.h>

#include <stdexcept>

namespace tracked_mcf::host {

struct Filter::Loaded {
    explicit Loaded(const std::string& file) {
        try {
            filter = dynamic_cast<FilterPlugin*>(manager.loadPlugin(QString::fromStdString(file)));
        } catch (const MLException& error) {
            throw std::runtime_error(error.what());
        }
        if (filter == nullptr) throw std::runtime_error(file + " holds no filters");
    }

    PluginManager manager;
    FilterPlugin* filter = nullptr;
    QAction* action = nullptr;
};

Filter::Filter(const std::string& plugin_file, const std::string& name)
    : loaded_(std::make_unique<Loaded>(plugin_file)) {
    for (QAction* action : loaded_->filter->actions()) {
        const bool wanted = name.empty() || action->text().toStdString() == name;
        if (wanted && loaded_->action == nullptr) loaded_->action = action;
    }
    if (loaded_->action == nullptr) throw std::runtime_error("No filter " + name);
}

Filter::~Filter() = default;

Declaration Filter::declaration() const {
    FilterPlugin& filter = *loaded_->filter;
    QAction* const action = loaded_->action;
    const auto [version, has_doubles] = filter.getMLVersion();
    return {action->text().toStdString(),
            filter.pythonFilterName(action).toStdString(),
            filter.filterInfo(action).toStdString(),
            version + (has_doubles ? " double" : " float"),
            filter.getClass(action) == FilterPlugin::Smoothing,
            filter.filterArity(action) == FilterPlugin::SINGLE_MESH,
            filter.getRequirements(action),
            filter.postCondition(action)};
}

int Filter::filters_in_plugin() const {
    return static_cast<int>(loaded_->filter->actions().size());
}

bool Filter::is_applicable(const MeshModel& layer) const {
    QStringList missing;
    return loaded_->filter->isFilterApplicable(loaded_->action, layer, missing);
}

RichParameterList Filter::parameters(MeshDocument& document) const {
    return loaded_->filter->initParameterList(loaded_->action, document);
}

Outcome Filter::apply(MeshDocument& document, const RichParameterList& parameters,
                      vcg::CallBackPos* callback) const {
    if (document.mm() != nullptr) {
        document.mm()->updateDataMask(loaded_->filter->getRequirements(loaded_->action));
    }
    GLLogStream log;
    FilterPlugin& filter = *loaded_->filter;
    filter.setLog(&log);
    Outcome outcome{};
    try {
        unsigned int post_condition = MeshModel::MM_UNKNOWN;
        outcome.outputs =
            filter.applyFilter(loaded_->action, parameters, document, post_condition, callback);
        outcome.succeeded = true;
    } catch (const MLException& error) {  // all that hosts catch, but for a lack of memory
        outcome.message = error.what();
    }
    filter.setLog(nullptr);
    QStringList lines;
    log.print(lines);
    outcome.log = lines.join("\n").toStdString();
    return outcome;
}

MeshModel& add_layer(MeshDocument& document, const char* label) {
    return *document.addNewMesh(QString(), label, true);
}

void hide(MeshModel& layer) {
    layer.setVisible(false);
}

void make_room(MeshModel& layer, int io_mask) {
    layer.enable(io_mask);
}

std::unique_ptr<Value> choice(int index) {
    return std::make_unique<IntValue>(index);
}

}  // namespace tracked_mcf::host
