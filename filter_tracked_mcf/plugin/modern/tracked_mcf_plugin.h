#pragma once

#include "meshlab_api.h"

namespace tracked_mcf {

/// The filter as MeshLab 2022.02 and later, and PyMeshLab, see it: translates between their types
/// and parameter_table() and run_filter(), and no more.
class TrackedMcfPlugin : public QObject, public FilterPlugin {
    Q_OBJECT
    MESHLAB_PLUGIN_IID_EXPORTER(FILTER_PLUGIN_IID)
    Q_INTERFACES(FilterPlugin)

public:
    TrackedMcfPlugin();

    QString pluginName() const override;
    QString vendor() const override;
    QString filterName(ActionIDType filter) const override;
    QString pythonFilterName(ActionIDType filter) const override;
    QString filterInfo(ActionIDType filter) const override;
    FilterClass getClass(const QAction* action) const override;
    FilterArity filterArity(const QAction* action) const override;
    int getPreConditions(const QAction* action) const override;
    int postCondition(const QAction* action) const override;
    RichParameterList initParameterList(const QAction* action,
                                        const MeshDocument& document) override;
    std::map<std::string, QVariant> applyFilter(const QAction* action,
                                                const RichParameterList& parameters,
                                                MeshDocument& document,
                                                unsigned int& post_condition_mask,
                                                vcg::CallBackPos* callback) override;
};

}  // namespace tracked_mcf
