#include "filter_tracked_mcf/plugin/legacy/tracked_mcf_plugin.h"

#include <optional>

#include "filter_tracked_mcf/parameters/parameter_table.h"
#include "filter_tracked_mcf/plugin/run_filter.h"

namespace tracked_mcf {

namespace {

constexpr int kMeanCurvatureFlow = 0;

using Integer = ParameterDescription::Integer;
using Real = ParameterDescription::Real;
using Boolean = ParameterDescription::Boolean;
using SelectionSwitch = ParameterDescription::SelectionSwitch;
using Choice = ParameterDescription::Choice;

QString text(const std::string& string) {
    return QString::fromStdString(string);
}

QStringList texts(const std::vector<std::string>& strings) {
    QStringList result;
    for (const std::string& string : strings) result << text(string);
    return result;
}

/// Adds a description of the table to what a dialog shows.
struct AddParameter {
    RichParameterList& list;
    bool has_selection;
    const ParameterDescription& description;

    void operator()(const Integer& type) const { add<RichInt>(type.default_value); }
    void operator()(const Real& type) const {
        add<RichFloat>(static_cast<float>(type.default_value));
    }
    void operator()(const Boolean& type) const { add<RichBool>(type.default_value); }
    void operator()(const SelectionSwitch&) const { add<RichBool>(has_selection); }
    void operator()(const Choice& type) const {
        add<RichEnum>(type.default_value, texts(type.labels));
    }

    template <class RichType, class... Arguments>
    void add(const Arguments&... arguments) const {
        list.addParam(RichType(text(description.name), arguments..., text(description.label),
                               text(description.tooltip)));
    }
};

/// Reads what a dialog or script gives for a description of the table. What has another type is
/// left out, since the release's own getters would end the program.
struct ReadValue {
    const Value& value;

    using Result = std::optional<ParameterValue>;
    Result operator()(const Integer&) const {
        return value.isInt() ? Result(value.getInt()) : std::nullopt;
    }
    Result operator()(const Real&) const {
        return value.isFloat() ? Result(shortest_decimal(value.getFloat())) : std::nullopt;
    }
    Result operator()(const Boolean&) const {
        return value.isBool() ? Result(value.getBool()) : std::nullopt;
    }
    Result operator()(const SelectionSwitch&) const { return operator()(Boolean()); }
    Result operator()(const Choice&) const {
        return value.isEnum() ? Result(value.getEnum()) : std::nullopt;
    }
};

ParameterValues read_values(const RichParameterList& list) {
    ParameterValues values;
    for (const ParameterDescription& description : parameter_table()) {
        const QString name = text(description.name);
        if (!list.hasParameter(name)) continue;
        const ReadValue read{list.getParameterByName(name).value()};
        if (const auto value = std::visit(read, description.type)) {
            values[description.name] = *value;
        }
    }
    return values;
}

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
    const MeshModel* const layer = document.mm();
    const bool has_selection = layer != nullptr && has_selected_faces(layer->cm);
    for (const ParameterDescription& parameter : parameter_table()) {
        std::visit(AddParameter{parameters, has_selection, parameter}, parameter.type);
    }
}

bool TrackedMcfPlugin::applyFilter(QAction*, MeshDocument& document,
                                   const RichParameterList& parameters,
                                   vcg::CallBackPos* callback) {
    const FilterOutcome outcome = guard([&] {
        MeshModel* const layer = document.mm();
        if (layer == nullptr) throw InvalidMesh("There is no layer to smooth; open a mesh first.");
        std::string done = run_filter(layer->cm, read_values(parameters), callback);
        layer->UpdateBoxAndNormals();
        return done;
    });
    if (!outcome.succeeded) errorMessage = text(outcome.message);
    // Of a failure, too: meshlabserver prints the log but not the error message.
    Log(outcome.message);
    return outcome.succeeded;
}

}  // namespace tracked_mcf
