// SPDX-License-Identifier: GPL-3.0-or-later
#include "release.h"

#include <QFileInfo>
#include <stdexcept>

namespace tracked_mcf::host {

PluginFile::PluginFile(const std::string& file)
    : loader_(QFileInfo(QString::fromStdString(file)).absoluteFilePath()),
      filters_(qobject_cast<FilterInterface*>(loader_.instance())) {
    if (filters_ == nullptr) throw std::runtime_error(loader_.errorString().toStdString());
}

RichParameterList parameters_of(FilterInterface& filters, QAction* action, MeshDocument& document) {
    RichParameterList list;
    filters.initParameterSet(action, document, list);
    return list;
}

void run(FilterInterface& filters, QAction* action, MeshDocument& document,
         const RichParameterList& parameters, vcg::CallBackPos* callback, Outcome& outcome) {
    outcome.succeeded = filters.applyFilter(action, document, parameters, callback);
    if (!outcome.succeeded) outcome.message = filters.errorMsg().toStdString();
}

MeshModel& add_layer(MeshDocument& document, const char* label) {
    return *document.addNewMesh("", label, true);
}

void delete_layer(MeshDocument& document, MeshModel& layer) {
    document.delMesh(&layer);
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
