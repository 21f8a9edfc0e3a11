// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/presentation/filter_names.h"
#include "tests/hosts/host.h"
#include "tests/hosts/layer.h"

namespace tracked_mcf {

/// Returns the filter of this name in the built plugin.
inline const host::Filter& filter(const std::string& name = kNames<FlowParameters>.name) {
    static std::map<std::string, host::Filter> filters;
    return filters.try_emplace(name, TRACKED_MCF_PLUGIN_FILE, name).first->second;
}

/// A document with one layer, and a filter's parameters with the dialog's defaults.
class Plugin : public testing::Test {
protected:
    explicit Plugin(std::string filter_name = kNames<FlowParameters>.name)
        : name(std::move(filter_name)), layer(host::add_layer(document, "layer")) {
        make_layer(layer);
        parameters = filter(name).parameters(document);
        if (name == kNames<FlowParameters>.name) {
            parameters.setValue("iterations", IntValue(2));
            parameters.setValue("depth", IntValue(4));
        }
        // Some faces of the layer are selected.
        if (parameters.hasParameter("selected")) {
            parameters.setValue("selected", BoolValue(false));
        }
    }

    bool apply(vcg::CallBackPos* callback = nullptr) {
        outcome = filter(name).apply(document, parameters, callback);
        return outcome.succeeded;
    }

    /// Selects the faces of half of the layer. Returns whether a vertex has other faces, too.
    std::vector<bool> select_half() {
        std::vector<bool> stays(layer.cm.vert.size(), false);
        for (CFaceO& face : layer.cm.face) {
            const bool selected = face.cV(0)->cP()[0] > 0;
            selected ? face.SetS() : face.ClearS();
            for (int corner = 0; !selected && corner < 3; ++corner) {
                stays[vcg::tri::Index(layer.cm, face.cV(corner))] = true;
            }
        }
        return stays;
    }

    const std::string name;
    MeshDocument document;
    MeshModel& layer;
    RichParameterList parameters;
    host::Outcome outcome{};
};

/// What the user does in the first callback from this percentage on.
inline std::function<void()> action;
inline int action_percent = 0;

inline bool process_events(int percent, const char*) {
    if (percent >= action_percent) {
        if (const auto act = std::exchange(action, nullptr)) act();
    }
    return true;
}

inline bool contains(const std::string& text, const std::string& word) {
    return text.find(word) != std::string::npos;
}

}  // namespace tracked_mcf
