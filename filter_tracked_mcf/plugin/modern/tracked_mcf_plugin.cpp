#include "filter_tracked_mcf/plugin/modern/tracked_mcf_plugin.h"

#include "filter_tracked_mcf/parameters/parameter_table.h"
#include "filter_tracked_mcf/plugin/current_layer.h"
#include "filter_tracked_mcf/plugin/rich_parameters.h"

namespace tracked_mcf {

namespace {

constexpr int kMeanCurvatureFlow = 0;

std::map<std::string, QVariant> as_variants(const Outputs& outputs) {
    std::map<std::string, QVariant> variants;
    for (const auto& [name, output] : outputs) {
        variants[name] = std::visit([](auto number) { return QVariant(number); }, output);
    }
    return variants;
}

}  // namespace

TrackedMcfPlugin::TrackedMcfPlugin() {
    typeList = {kMeanCurvatureFlow};
    actionList = {new QAction(kFilterName, this)};
}

QString TrackedMcfPlugin::pluginName() const {
    return "FilterTrackedMcf";
}

QString TrackedMcfPlugin::vendor() const {
    return "Filter Tracked MCF";
}

QString TrackedMcfPlugin::filterName(ActionIDType) const {
    return kFilterName;
}

QString TrackedMcfPlugin::pythonFilterName(ActionIDType) const {
    return kPythonFilterName;
}

QString TrackedMcfPlugin::filterInfo(ActionIDType) const {
    return kFilterHelp;
}

FilterPlugin::FilterClass TrackedMcfPlugin::getClass(const QAction*) const {
    return Smoothing;
}

FilterPlugin::FilterArity TrackedMcfPlugin::filterArity(const QAction*) const {
    return SINGLE_MESH;
}

int TrackedMcfPlugin::getPreConditions(const QAction*) const {
    return MeshModel::MM_FACENUMBER;
}

// Neither vertices nor faces come or go: with either in the mask a dialog offers no preview.
int TrackedMcfPlugin::postCondition(const QAction*) const {
    return MeshModel::MM_VERTCOORD | MeshModel::MM_VERTNORMAL | MeshModel::MM_FACENORMAL;
}

// Of the two overloads the one for which a document may be without a layer.
RichParameterList TrackedMcfPlugin::initParameterList(const QAction*,
                                                      const MeshDocument& document) {
    return rich_parameters(document.mm());
}

std::map<std::string, QVariant> TrackedMcfPlugin::applyFilter(const QAction*,
                                                              const RichParameterList& parameters,
                                                              MeshDocument& document,
                                                              unsigned int& post_condition_mask,
                                                              vcg::CallBackPos* callback) {
    const FilterOutcome outcome = smooth_current_layer(document, parameters, callback);
    // The one kind of exception that hosts expect.
    if (!outcome.succeeded) throw MLException(QString::fromStdString(outcome.message));
    log(outcome.message);
    post_condition_mask = static_cast<unsigned int>(postCondition(nullptr));
    return as_variants(outcome.outputs);
}

}  // namespace tracked_mcf
