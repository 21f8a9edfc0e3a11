#include "tests/hosts/host.h"

#include <QFileInfo>
#include <QPluginLoader>
#include <stdexcept>

namespace tracked_mcf::host {

struct Filter::Loaded {
    explicit Loaded(const std::string& file)
        : loader(QFileInfo(QString::fromStdString(file)).absoluteFilePath()) {
        filter = qobject_cast<MeshFilterInterface*>(loader.instance());
        if (filter == nullptr) throw std::runtime_error(loader.errorString().toStdString());
    }

    QPluginLoader loader;
    MeshFilterInterface* filter;
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
    MeshFilterInterface& filter = *loaded_->filter;
    QAction* const action = loaded_->action;
    return {action->text().toStdString(),
            "",
            filter.filterInfo(action).toStdString(),
            "",
            filter.getClass(action) == MeshFilterInterface::Smoothing,
            filter.filterArity(action) == MeshFilterInterface::SINGLE_MESH,
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
    RichParameterList list;
    loaded_->filter->initParameterSet(loaded_->action, document, list);
    return list;
}

Outcome Filter::apply(MeshDocument& document, const RichParameterList& parameters,
                      vcg::CallBackPos* callback) const {
    if (document.mm() != nullptr) {
        document.mm()->updateDataMask(loaded_->filter->getRequirements(loaded_->action));
    }
    GLLogStream log;
    MeshFilterInterface& filter = *loaded_->filter;
    filter.setLog(&log);
    const bool succeeded = filter.applyFilter(loaded_->action, document, parameters, callback);
    filter.setLog(nullptr);
    QStringList lines;
    log.print(lines);
    return {succeeded,
            succeeded ? "" : filter.errorMsg().toStdString(),
            lines.join("\n").toStdString(),
            {}};
}

MeshModel& add_layer(MeshDocument& document, const char* label) {
    return *document.addNewMesh("", label, true);
}

void hide(MeshModel& layer) {
    layer.visible = false;
}

void make_room(MeshModel& layer, int io_mask) {
    layer.Enable(io_mask);
}

std::unique_ptr<Value> choice(int index) {
    return std::make_unique<EnumValue>(index);
}

}  // namespace tracked_mcf::host
