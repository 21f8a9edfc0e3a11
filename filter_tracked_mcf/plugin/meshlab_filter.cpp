// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/plugin/meshlab_filter.h"

#include <QPointer>
#include <optional>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/parameters/parameter_table.h"
#include "filter_tracked_mcf/plugin/parameter_values.h"

namespace tracked_mcf {

namespace {

using Integer = ParameterDescription::Integer;
using Real = ParameterDescription::Real;
using Length = ParameterDescription::Length;
using Boolean = ParameterDescription::Boolean;
using SelectionSwitch = ParameterDescription::SelectionSwitch;
using Choice = ParameterDescription::Choice;

QString text(const std::string& string) {
    return QString::fromStdString(string);
}

/// Returns a text as HTML. MeshLab would draw a plain tooltip as one long line.
QString rich(const std::string& string) {
    return "<span>" + text(string).toHtmlEscaped() + "</span>";
}

QStringList texts(const std::vector<std::string>& strings) {
    QStringList result;
    for (const std::string& string : strings) result << text(string);
    return result;
}

/// Adds one parameter of the table to a dialog.
struct AddParameter {
    RichParameterList& list;
    const MeshModel* layer;
    const ParameterDescription& description;

    void operator()(const Integer& type) const { add<RichInt>(type.default_value); }
    void operator()(const Real& type) const {
        add<RichFloat>(static_cast<Scalarm>(type.default_value));
    }
    void operator()(const Length&) const {
        const double length = layer == nullptr ? 0 : default_detail_size_of(layer->cm);
        const Scalarm diagonal = layer == nullptr ? 1 : layer->cm.bbox.Diag();
        add<RichLength>(static_cast<Scalarm>(length), Scalarm(0), diagonal);
    }
    void operator()(const Boolean& type) const { add<RichBool>(type.default_value); }
    void operator()(const SelectionSwitch&) const {
        add<RichBool>(layer != nullptr && has_selected_faces(layer->cm));
    }
    void operator()(const Choice& type) const {
        add<RichEnum>(type.default_value, texts(type.labels));
    }

    template <class RichType, class... Arguments>
    void add(const Arguments&... arguments) const {
        list.addParam(RichType(text(description.name), arguments..., text(description.label),
                               rich(description.tooltip)));
    }
};

/// Reads the value of one parameter of the table; empty if it has another type.
struct ReadValue {
    const Value& value;

    using Result = std::optional<ParameterValue>;
    Result operator()(const Integer&) const {
        return value.isInt() ? Result(value.getInt()) : std::nullopt;
    }
    Result operator()(const Real&) const {
        return value.isFloat() ? Result(as_typed(value.getFloat())) : std::nullopt;
    }
    Result operator()(const Length&) const { return operator()(Real{}); }
    Result operator()(const Boolean&) const {
        return value.isBool() ? Result(value.getBool()) : std::nullopt;
    }
    Result operator()(const SelectionSwitch&) const { return operator()(Boolean()); }
    Result operator()(const Choice&) const {
        return holds_choice(value) ? Result(choice_of(value)) : std::nullopt;
    }
};

/// Returns the values that a dialog or script gives for the parameters of the table. It leaves out
/// missing values and values of another type, so that flow_parameters() can report them: MeshLab's
/// getters would end the program.
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

/// Marks that this thread runs the filter. Throws Error if it does already: MeshLab's callback
/// processes events, so a user can apply the filter while it runs.
class Run {
public:
    Run() {
        if (runs) {
            throw Error(
                "The filter is already running. Wait until it is done, then apply it again.");
        }
        runs = true;
    }
    ~Run() { runs = false; }
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;

private:
    static thread_local bool runs;
};

thread_local bool Run::runs = false;

/// Wraps the host's callback, which may be null. Stops if a user has deleted the layer meanwhile,
/// or closed its document.
Progress watched_progress(MeshDocument& document, const MeshModel& layer,
                          vcg::CallBackPos* callback) {
    if (callback == nullptr) return {};
    return [report = as_progress(callback), pointer = QPointer<MeshDocument>(&document),
            id = layer.id()](double fraction, std::string_view phase) {
        const bool goes_on = report(fraction, phase);
        if (pointer.isNull() || pointer->getMesh(id) == nullptr) {
            throw InvalidMesh("The layer was deleted while the filter ran, so the filter stopped.");
        }
        return goes_on;
    };
}

}  // namespace

RichParameterList rich_parameters(const MeshModel* layer) {
    RichParameterList list;
    for (const ParameterDescription& parameter : parameter_table()) {
        std::visit(AddParameter{list, layer, parameter}, parameter.type);
    }
    return list;
}

FilterOutcome smooth_current_layer(MeshDocument& document, const RichParameterList& parameters,
                                   vcg::CallBackPos* callback) {
    return guard([&] {
        const Run run;
        MeshModel* const layer = document.mm();
        if (layer == nullptr) throw InvalidMesh("There is no layer to smooth; open a mesh first.");
        const ParameterValues values = read_values(parameters);
        FilterOutcome outcome =
            run_filter(layer->cm, values, watched_progress(document, *layer, callback));
        update_box_and_normals(*layer);
        if (flow_parameters(values).quality != Quality::None) {
            layer->updateDataMask(MeshModel::MM_VERTQUALITY);
        }
        return outcome;
    });
}

}  // namespace tracked_mcf
