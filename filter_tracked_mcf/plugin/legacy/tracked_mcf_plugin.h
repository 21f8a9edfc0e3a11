#pragma once

#include "meshlab_api.h"

namespace tracked_mcf {

/// The filter as MeshLab 2020.09 sees it: translates between its types and parameter_table() and
/// run_filter(), and no more.
class TrackedMcfPlugin : public QObject, public MeshFilterInterface {
    Q_OBJECT
    MESHLAB_PLUGIN_IID_EXPORTER(MESH_FILTER_INTERFACE_IID)
    Q_INTERFACES(MeshFilterInterface)

public:
    TrackedMcfPlugin();

    QString pluginName() const override;
    QString filterName(FilterIDType filter) const override;
    QString filterInfo(FilterIDType filter) const override;
    FilterClass getClass(QAction* action) override;
    FILTER_ARITY filterArity(QAction* action) const override;
    int getPreConditions(QAction* action) const override;
    int postCondition(QAction* action) const override;
    void initParameterSet(QAction* action, MeshDocument& document,
                          RichParameterList& parameters) override;
    bool applyFilter(QAction* action, MeshDocument& document, const RichParameterList& parameters,
                     vcg::CallBackPos* callback) override;
};

}  // namespace tracked_mcf
