// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/hosts/meshlab/meshlab_filter.h"

namespace tracked_mcf {

/// The filters for MeshLab 2020.09. It only translates between MeshLab's types and ours.
class TrackedMcfPlugin : public QObject, public MeshFilterInterface {
    Q_OBJECT
    MESHLAB_PLUGIN_IID_EXPORTER(MESH_FILTER_INTERFACE_IID)
    Q_INTERFACES(MeshFilterInterface)

public:
    TrackedMcfPlugin() {
        for (const MeshLabFilter& filter : meshlab_filters()) {
            typeList << typeList.size();
            actionList << new QAction(filter.names.name, this);
        }
    }

    QString pluginName() const override { return "FilterTrackedMcf"; }
    QString filterName(FilterIDType id) const override { return filter(id).names.name; }
    QString filterInfo(FilterIDType id) const override {
        return QString(filter(id).names.help) + "<br>" + kBuild + ".";
    }
    FilterClass getClass(QAction*) override { return Smoothing; }
    FILTER_ARITY filterArity(QAction*) const override { return SINGLE_MESH; }
    int getPreConditions(QAction*) const override { return MeshModel::MM_FACENUMBER; }

    // The mask leaves out vertex and face numbers: with either, the dialog has no preview.
    int postCondition(QAction*) const override {
        return MeshModel::MM_VERTCOORD | MeshModel::MM_VERTNORMAL | MeshModel::MM_FACENORMAL |
               MeshModel::MM_VERTQUALITY;
    }

    // Hosts call this one of the two overloads. meshlabserver calls it without a layer.
    void initParameterSet(QAction* action, MeshDocument& document,
                          RichParameterList& parameters) override;
    bool applyFilter(QAction* action, MeshDocument& document, const RichParameterList& parameters,
                     vcg::CallBackPos* callback) override;

private:
    static const MeshLabFilter& filter(FilterIDType id) { return meshlab_filters().at(id); }
};

}  // namespace tracked_mcf
