// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <QPluginLoader>

#include "tests/hosts/host.h"

// The functions that host.cpp calls, for MeshLab 2020.09.
namespace tracked_mcf::host {

using FilterInterface = MeshFilterInterface;

/// A plugin, loaded as in this release. Throws std::runtime_error if that fails.
class PluginFile {
public:
    explicit PluginFile(const std::string& file);
    FilterInterface& filters() const { return *filters_; }

private:
    QPluginLoader loader_;
    FilterInterface* filters_;
};

/// This release has neither.
inline std::string python_name(const FilterInterface&, const QAction*) {
    return "";
}
inline std::string built_for(const FilterInterface&) {
    return "";
}

RichParameterList parameters_of(FilterInterface& filters, QAction* action, MeshDocument& document);

/// Applies a filter and sets the outcome, except for its log.
void run(FilterInterface& filters, QAction* action, MeshDocument& document,
         const RichParameterList& parameters, vcg::CallBackPos* callback, Outcome& outcome);

}  // namespace tracked_mcf::host
