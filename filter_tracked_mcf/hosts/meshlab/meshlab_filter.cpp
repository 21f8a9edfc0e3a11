// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/hosts/meshlab/meshlab_filter.h"

#include <QPointer>
#include <optional>
#include <utility>
#include <variant>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/parameter_table.h"
#include "filter_tracked_mcf/hosts/meshlab/filter_dialog.h"
#include "filter_tracked_mcf/presentation/filter_names.h"

namespace tracked_mcf {

namespace {

QString text(const std::string& string) {
    return QString::fromStdString(string);
}

/// Returns a text as HTML. MeshLab would draw a plain tooltip as one long line.
QString rich(const std::string& string) {
    return "<span>" + text(string).toHtmlEscaped() + "</span>";
}

QStringList labels(const std::vector<NamedChoice>& choices) {
    QStringList result;
    for (const NamedChoice& choice : choices) result << text(choice.label);
    return result;
}

/// Returns the length that a dialog begins with.
double initial_length(const ParameterOf<FlowParameters>& /*detail_size*/, const MeshModel& layer) {
    return default_detail_size_of(layer.cm);
}

template <class Parameters>
double initial_length(const ParameterOf<Parameters>& length, const MeshModel& /*layer*/) {
    return std::get<double>(length.initial);
}

/// Adds a parameter, with its default, to a dialog.
template <class Parameters>
void add(RichParameterList& list, const ParameterOf<Parameters>& parameter,
         const MeshModel* layer) {
    const QString name = text(parameter.name), label = text(parameter.label);
    const QString help = rich(parameter.help);
    const ParameterValue& value = parameter.initial;
    const auto add_rich = [&list](const auto& rich_parameter) { list.addParam(rich_parameter); };
    switch (parameter.type) {
        case Parameter::Type::Switch:
            return add_rich(RichBool(name, std::get<bool>(value), label, help));
        case Parameter::Type::Integer:
            return add_rich(RichInt(name, std::get<int>(value), label, help));
        case Parameter::Type::Real:
            return add_rich(
                RichFloat(name, static_cast<Scalarm>(std::get<double>(value)), label, help));
        case Parameter::Type::Length: {
            const double length = layer == nullptr ? 0 : initial_length(parameter, *layer);
            const Scalarm diagonal = layer == nullptr ? 1 : layer->cm.bbox.Diag();
            return add_rich(
                RichLength(name, static_cast<Scalarm>(length), 0, diagonal, label, help));
        }
        case Parameter::Type::Choice:
            return add_rich(
                RichEnum(name, std::get<int>(value), labels(parameter.choices), label, help));
    }
}

/// Returns the value that a dialog or script gives. Throws InvalidParameter if it is missing or has
/// another type: MeshLab's getters would end the program.
ParameterValue read(const RichParameterList& list, const Parameter& parameter) {
    if (list.hasParameter(text(parameter.name))) {
        const Value& value = list.getParameterByName(text(parameter.name)).value();
        const ParameterValue& initial = parameter.initial;
        const bool is_choice = parameter.type == Parameter::Type::Choice;
        if (is_choice && holds_choice(value)) return choice_of(value);
        if (parameter.type == Parameter::Type::Integer && value.isInt()) return value.getInt();
        if (std::holds_alternative<bool>(initial) && value.isBool()) return value.getBool();
        if (std::holds_alternative<double>(initial) && value.isFloat()) {
            return static_cast<double>(value.getFloat());
        }
    }
    throw InvalidParameter(parameter.name,
                           "is missing or has the wrong type. Save a filter script in MeshLab to "
                           "see how it is written.");
}

/// A run of a filter, at most one for each thread. MeshLab's callback processes events, so MeshLab
/// can apply a filter while one runs: a key in a dialog whose *Preview* is ticked begins a preview.
class Run {
public:
    Run(MeshDocument& document, const char* filter)
        : dialog_(filter), document_(&document), filter_(filter) {
        current = this;
    }
    ~Run() { current = nullptr; }
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;

    /// The run of this thread, or null.
    static thread_local Run* current;

    /// Takes parameters that are to replace those of this run, and returns the outcome of the call
    /// that has brought them. The dialog then waits for this run.
    FilterOutcome replace(const MeshDocument& document, const char* filter,
                          const RichParameterList& parameters) {
        if (&document != document_ || filter != filter_) {
            return {false,
                    "A filter is already running. It goes on when this message is closed: apply "
                    "this filter again when it is done.",
                    {}};
        }
        if (dialog_.applies()) {
            dialog_.preview_afterwards();
        } else {
            newer_ = parameters;
        }
        return {true, "", {}};
    }

    /// Wraps the host's callback, which may be null. Stops if a user has deleted the layer
    /// meanwhile, or closed its document.
    Progress watched_progress(const MeshModel& layer, vcg::CallBackPos* callback) const {
        if (callback == nullptr) return {};
        return [this, report = as_progress(callback), document = QPointer<MeshDocument>(document_),
                id = layer.id()](double fraction, std::string_view phase) {
            const bool goes_on = report(fraction, phase);
            if (document.isNull() || document->getMesh(id) == nullptr) {
                throw InvalidMesh(
                    "The layer was deleted while the filter ran, so the filter stopped.");
            }
            return goes_on && !newer_ && !dialog_.ends_run();
        };
    }

    /// Returns what `apply` returns for `parameters`, or for those that have replaced them.
    template <class Apply>
    FilterOutcome finish(RichParameterList parameters, const Apply& apply) {
        for (;;) {
            try {
                return apply(parameters);
            } catch (const Cancelled&) {
                // MeshLab will log that the filter was applied: after a failure it shows a message.
                if (dialog_.ends_run()) {
                    return {true, "The run was ended. The layer is as it was.", {}};
                }
                if (!newer_) throw;
            }
            parameters = *std::exchange(newer_, std::nullopt);
            // MeshLab has taken the call that brought them for the end of this run: it has logged
            // that, and forgotten the layer. It would draw the layer as it draws a new one.
            take_back_log(*document_);
            document_->meshDocStateData().clear();
            document_->meshDocStateData().create(*document_);
        }
    }

private:
    FilterDialog dialog_;
    MeshDocument* document_;
    const char* filter_;
    std::optional<RichParameterList> newer_;
};

thread_local Run* Run::current = nullptr;

template <class Parameters>
RichParameterList rich_parameters(const MeshModel* layer) {
    RichParameterList list;
    for (const auto& parameter : parameter_table<Parameters>()) {
        if (!parameter.label.empty()) add(list, parameter, layer);
    }
    for (const Input& input : input_table<Parameters>()) {
        if (input.label.empty()) continue;
        const bool is_on = input.of_faces && layer != nullptr && has_selected_faces(layer->cm);
        list.addParam(RichBool(text(input.name), is_on, text(input.label), rich(input.help)));
    }
    return list;
}

/// See MeshLabFilter::apply.
template <class Parameters>
FilterOutcome apply_to_current_layer(MeshDocument& document, const RichParameterList& list,
                                     vcg::CallBackPos* callback) {
    const char* const name = kNames<Parameters>.name;
    if (Run::current != nullptr) return Run::current->replace(document, name, list);
    Run run(document, name);
    const auto apply = [&](const RichParameterList& newest) {
        MeshModel* const layer = document.mm();
        if (layer == nullptr) throw InvalidMesh("There is no layer to smooth; open a mesh first.");
        Parameters parameters;
        for (const auto& parameter : parameter_table<Parameters>()) {
            if (!parameter.label.empty()) parameter.set(parameters, read(newest, parameter));
        }
        Inputs inputs;
        for (const Input& input : input_table<Parameters>()) {
            // An input without a label is always taken.
            if (!input.label.empty() && !std::get<bool>(read(newest, input))) continue;
            if (input.of_faces) {
                inputs.*input.of_faces = selected_faces(layer->cm);
            } else if (layer->hasDataMask(MeshModel::MM_VERTQUALITY)) {
                inputs.*input.of_vertices = vertex_quality(layer->cm);
            } else {
                throw InvalidMesh(kNoQuality);
            }
        }
        FilterOutcome outcome =
            run_filter(layer->cm, parameters, inputs, run.watched_progress(*layer, callback));
        update_box_and_normals(*layer);
        if (parameters.quality != Quality::None) {
            layer->updateDataMask(MeshModel::MM_VERTQUALITY);
        }
        return outcome;
    };
    return guard([&] { return run.finish(list, apply); });
}

template <class Parameters>
MeshLabFilter filter_of() {
    return {kNames<Parameters>, rich_parameters<Parameters>, apply_to_current_layer<Parameters>};
}

}  // namespace

const std::vector<MeshLabFilter>& meshlab_filters() {
    static const std::vector<MeshLabFilter> filters = {
        filter_of<FlowParameters>(), filter_of<NoiseParameters>(), filter_of<FairParameters>()};
    return filters;
}

}  // namespace tracked_mcf
