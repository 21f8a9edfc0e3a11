// SPDX-License-Identifier: GPL-3.0-or-later
#include "release.h"

#include <stdexcept>

namespace tracked_mcf::host {

namespace {

FilterInterface* load(PluginManager& manager, const std::string& file) {
    try {
        return dynamic_cast<FilterInterface*>(manager.loadPlugin(QString::fromStdString(file)));
    } catch (const MLException& error) {
        throw std::runtime_error(error.what());
    }
}

}  // namespace

PluginFile::PluginFile(const std::string& file) : filters_(load(manager_, file)) {
    if (filters_ == nullptr) throw std::runtime_error(file + " holds no filters");
}

std::string python_name(const FilterInterface& filters, const QAction* action) {
    return filters.pythonFilterName(action).toStdString();
}

std::string built_for(const FilterInterface& filters) {
    const auto [version, has_doubles] = filters.getMLVersion();
    return version + (has_doubles ? " double" : " float");
}

RichParameterList parameters_of(FilterInterface& filters, QAction* action, MeshDocument& document) {
    return filters.initParameterList(action, document);
}

void run(FilterInterface& filters, QAction* action, MeshDocument& document,
         const RichParameterList& parameters, vcg::CallBackPos* callback, Outcome& outcome) {
    try {
        unsigned int post_condition = MeshModel::MM_UNKNOWN;
        outcome.outputs =
            filters.applyFilter(action, parameters, document, post_condition, callback);
        outcome.succeeded = true;
    } catch (const MLException& error) {
        outcome.message = error.what();
    }
}

MeshModel& add_layer(MeshDocument& document, const char* label) {
    return *document.addNewMesh(QString(), label, true);
}

void delete_layer(MeshDocument& document, MeshModel& layer) {
    document.delMesh(static_cast<unsigned int>(layer.id()));
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
