#include "filter_tracked_mcf/plugin/legacy/tracked_mcf_plugin.h"

#include "filter_tracked_mcf/parameters/parameter_table.h"
#include "filter_tracked_mcf/plugin/current_layer.h"
#include "filter_tracked_mcf/plugin/rich_parameters.h"

namespace tracked_mcf {

namespace {

constexpr int kMeanCurvatureFlow = 0;

}  // namespace

TrackedMcfPlugin::TrackedMcfPlugin() {
    typeList << kMeanCurvatureFlow;
    actionList << new QAction(kFilterName, this);
}

QString TrackedMcfPlugin::pluginName() const {
    return "FilterTrackedMcf";
}

QString TrackedMcfPlugin::filterName(FilterIDType) const {
    return kFilterName;
}

QString TrackedMcfPlugin::filterInfo(FilterIDType) const {
    return kFilterHelp;
}

MeshFilterInterface::FilterClass TrackedMcfPlugin::getClass(QAction*) {
    return Smoothing;
}

MeshFilterInterface::FILTER_ARITY TrackedMcfPlugin::filterArity(QAction*) const {
    return SINGLE_MESH;
}

int TrackedMcfPlugin::getPreConditions(QAction*) const {
    return MeshModel::MM_FACENUMBER;
}

// Neither vertices nor faces come or go: with either in the mask a dialog offers no preview.
int TrackedMcfPlugin::postCondition(QAction*) const {
    return MeshModel::MM_VERTCOORD | MeshModel::MM_VERTNORMAL | MeshModel::MM_FACENORMAL;
}

// Of the two overloads this is the one that hosts call; meshlabserver does so without a layer.
void TrackedMcfPlugin::initParameterSet(QAction*, MeshDocument& document,
                                        RichParameterList& parameters) {
    parameters = rich_parameters(document.mm());
}

bool TrackedMcfPlugin::applyFilter(QAction*, MeshDocument& document,
                                   const RichParameterList& parameters,
                                   vcg::CallBackPos* callback) {
    const FilterOutcome outcome = smooth_current_layer(document, parameters, callback);
    if (!outcome.succeeded) errorMessage = QString::fromStdString(outcome.message);
    // Of a failure, too: meshlabserver prints the log but not the error message.
    Log(outcome.message);
    return outcome.succeeded;
}

}  // namespace tracked_mcf
