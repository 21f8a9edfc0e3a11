// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/hosts/host.h"
#include "tests/hosts/layer.h"

namespace tracked_mcf {

/// Returns the filter of the built plugin.
inline const host::Filter& filter() {
    static const host::Filter filter(TRACKED_MCF_PLUGIN_FILE);
    return filter;
}

/// A document with one layer, and the plugin's parameters with the dialog's defaults.
class Plugin : public testing::Test {
protected:
    Plugin() : layer(host::add_layer(document, "layer")) {
        make_layer(layer);
        parameters = filter().parameters(document);
        parameters.setValue("iterations", IntValue(2));
        parameters.setValue("depth", IntValue(4));
        // Some faces of the layer are selected.
        parameters.setValue("selected", BoolValue(false));
    }

    bool apply(vcg::CallBackPos* callback = nullptr) {
        outcome = filter().apply(document, parameters, callback);
        return outcome.succeeded;
    }

    MeshDocument document;
    MeshModel& layer;
    RichParameterList parameters;
    host::Outcome outcome{};
};

inline bool contains(const std::string& text, const std::string& word) {
    return text.find(word) != std::string::npos;
}

}  // namespace tracked_mcf
