#include "filter_tracked_mcf/plugin/rich_parameters.h"

#include <optional>

#include "filter_tracked_mcf/mesh_bridge/mesh_bridge.h"
#include "filter_tracked_mcf/parameters/parameter_table.h"

namespace tracked_mcf {

namespace {

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
        add<RichFloat>(static_cast<Scalarm>(type.default_value));
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

/// Reads a value for a description of the table.
struct ReadValue {
    const Value& value;

    using Result = std::optional<ParameterValue>;
    Result operator()(const Integer&) const {
        return value.isInt() ? Result(value.getInt()) : std::nullopt;
    }
    Result operator()(const Real&) const {
        return value.isFloat() ? Result(as_typed(value.getFloat())) : std::nullopt;
    }
    Result operator()(const Boolean&) const {
        return value.isBool() ? Result(value.getBool()) : std::nullopt;
    }
    Result operator()(const SelectionSwitch&) const { return operator()(Boolean()); }
    Result operator()(const Choice&) const {
        return holds_choice(value) ? Result(choice_of(value)) : std::nullopt;
    }
};

}  // namespace

RichParameterList rich_parameters(const MeshModel* layer) {
    RichParameterList list;
    const bool has_selection = layer != nullptr && has_selected_faces(layer->cm);
    for (const ParameterDescription& parameter : parameter_table()) {
        std::visit(AddParameter{list, has_selection, parameter}, parameter.type);
    }
    return list;
}

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

}  // namespace tracked_mcf
