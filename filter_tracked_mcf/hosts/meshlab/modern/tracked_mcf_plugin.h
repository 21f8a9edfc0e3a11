// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/hosts/meshlab/meshlab_filter.h"

namespace tracked_mcf {

/// The filters for MeshLab 2022.02 and later, and for PyMeshLab. It only translates between their
/// types and ours.
class TrackedMcfPlugin : public QObject, public FilterPlugin {
    Q_OBJECT
    MESHLAB_PLUGIN_IID_EXPORTER(FILTER_PLUGIN_IID)
    Q_INTERFACES(FilterPlugin)

public:
    TrackedMcfPlugin() {
        for (const MeshLabFilter& filter : meshlab_filters()) {
            typeList.push_back(static_cast<ActionIDType>(typeList.size()));
            actionList.push_back(new QAction(filter.names.name, this));
        }
    }

    QString pluginName() const override { return "FilterTrackedMcf"; }
    QString vendor() const override { return "Filter Tracked MCF"; }
    QString filterName(ActionIDType id) const override { return filter(id).names.name; }
    QString pythonFilterName(ActionIDType id) const override { return filter(id).names.python; }
    QString filterInfo(ActionIDType id) const override {
        return QString(filter(id).names.help) + "<br>" + kBuild + ".";
    }
    FilterClass getClass(const QAction*) const override { return Smoothing; }
    FilterArity filterArity(const QAction*) const override { return SINGLE_MESH; }
    int getPreConditions(const QAction*) const override { return MeshModel::MM_FACENUMBER; }

    // The mask leaves out vertex and face numbers: with either, the dialog has no preview.
    int postCondition(const QAction*) const override {
        return MeshModel::MM_VERTCOORD | MeshModel::MM_VERTNORMAL | MeshModel::MM_FACENORMAL |
               MeshModel::MM_VERTQUALITY;
    }

    // Hosts call this overload even if the document has no layer.
    RichParameterList initParameterList(const QAction* action,
                                        const MeshDocument& document) override;
    std::map<std::string, QVariant> applyFilter(const QAction* action,
                                                const RichParameterList& parameters,
                                                MeshDocument& document,
                                                unsigned int& post_condition_mask,
                                                vcg::CallBackPos* callback) override;

private:
    static const MeshLabFilter& filter(ActionIDType id) {
        return meshlab_filters().at(static_cast<std::size_t>(id));
    }
};

}  // namespace tracked_mcf
