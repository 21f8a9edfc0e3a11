// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <common/plugins/plugin_manager.h>

#include "tests/hosts/host.h"

// The functions that host.cpp calls, for MeshLab 2022.02 and later and for PyMeshLab.
namespace tracked_mcf::host {

using FilterInterface = FilterPlugin;

/// A plugin, loaded with the checks of this release. Throws std::runtime_error if that fails.
class PluginFile {
public:
    explicit PluginFile(const std::string& file);
    FilterInterface& filters() const { return *filters_; }

private:
    PluginManager manager_;
    FilterInterface* filters_;
};

std::string python_name(const FilterInterface& filters, const QAction* action);
std::string built_for(const FilterInterface& filters);
RichParameterList parameters_of(FilterInterface& filters, QAction* action, MeshDocument& document);

/// Applies a filter and sets the outcome, except for its log. Does not catch exceptions that hosts
/// do not catch.
void run(FilterInterface& filters, QAction* action, MeshDocument& document,
         const RichParameterList& parameters, vcg::CallBackPos* callback, Outcome& outcome);

}  // namespace tracked_mcf::host
