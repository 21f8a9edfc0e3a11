#pragma once

#include <QPluginLoader>

#include "tests/hosts/host.h"

// What host.cpp needs of MeshLab 2020.09.
namespace tracked_mcf::host {

using FilterInterface = MeshFilterInterface;

/// A plugin, loaded as this release does. Throws std::runtime_error if that fails.
class PluginFile {
public:
    explicit PluginFile(const std::string& file);
    FilterInterface& filters() const { return *filters_; }

private:
    QPluginLoader loader_;
    FilterInterface* filters_;
};

/// Of these this release knows nothing.
inline std::string python_name(const FilterInterface&, const QAction*) {
    return "";
}
inline std::string built_for(const FilterInterface&) {
    return "";
}

RichParameterList parameters_of(FilterInterface& filters, QAction* action, MeshDocument& document);

/// Applies a filter; says how that ended, but for the log.
void run(FilterInterface& filters, QAction* action, MeshDocument& document,
         const RichParameterList& parameters, vcg::CallBackPos* callback, Outcome& outcome);

}  // namespace tracked_mcf::host
