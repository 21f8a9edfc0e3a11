// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/parameters/filter_names.h"
#include "filter_tracked_mcf/plugin/meshlab_filter.h"

namespace tracked_mcf {

/// The filter for MeshLab 2020.09. It only translates between MeshLab's types and ours.
class TrackedMcfPlugin : public QObject, public MeshFilterInterface {
    Q_OBJECT
    MESHLAB_PLUGIN_IID_EXPORTER(MESH_FILTER_INTERFACE_IID)
    Q_INTERFACES(MeshFilterInterface)

public:
    TrackedMcfPlugin() {
        typeList << 0;
        actionList << new QAction(kFilterName, this);
    }

    QString pluginName() const override { return "FilterTrackedMcf"; }
    QString filterName(FilterIDType) const override { return kFilterName; }
    QString filterInfo(FilterIDType) const override {
        return QString(kFilterHelp) + "<br>" + kBuild + ".";
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
};

}  // namespace tracked_mcf
