// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "filter_tracked_mcf/parameters/filter_names.h"
#include "filter_tracked_mcf/plugin/meshlab_filter.h"

namespace tracked_mcf {

/// The filter for MeshLab 2022.02 and later, and for PyMeshLab. It only translates between their
/// types and ours.
class TrackedMcfPlugin : public QObject, public FilterPlugin {
    Q_OBJECT
    MESHLAB_PLUGIN_IID_EXPORTER(FILTER_PLUGIN_IID)
    Q_INTERFACES(FilterPlugin)

public:
    TrackedMcfPlugin() {
        typeList = {0};
        actionList = {new QAction(kFilterName, this)};
    }

    QString pluginName() const override { return "FilterTrackedMcf"; }
    QString vendor() const override { return "Filter Tracked MCF"; }
    QString filterName(ActionIDType) const override { return kFilterName; }
    QString pythonFilterName(ActionIDType) const override { return kPythonFilterName; }
    QString filterInfo(ActionIDType) const override {
        return QString(kFilterHelp) + "<br>" + kBuild + ".";
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
};

}  // namespace tracked_mcf
