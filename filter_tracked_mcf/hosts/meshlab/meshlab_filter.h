// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "filter_tracked_mcf/hosts/meshlab/run_filter.h"
#include "filter_tracked_mcf/presentation/filter_names.h"
#include "meshlab_api.h"

namespace tracked_mcf {

/// Which build this is: for the filter's help and its lines in MeshLab's log.
inline constexpr const char* kBuild = "Filter Tracked MCF " TRACKED_MCF_VERSION;

/// One of the plugin's filters, without the types that differ between MeshLab's releases.
struct MeshLabFilter {
    FilterNames names;

    /// Returns parameter_table() for MeshLab's dialogs and scripts. `selected` is on if `layer`,
    /// which may be null, has selected faces.
    RichParameterList (*parameters)(const MeshModel* layer);

    /// Applies the filter to the document's current layer and updates the layer's normals and
    /// bounding box, and its mask if it has got a quality. Never throws. A failure leaves the layer
    /// as it was.
    ///
    /// Hosts process the user's events in `callback`. If they apply the filter again meanwhile, the
    /// inner call returns at once, without a message and with the layer as it is. The outer call
    /// begins again, with the inner call's parameters and the layer that is then the current one.
    /// An outer call that the user ends succeeds, and leaves the layer as it was. See FilterDialog.
    ///
    /// Fails if this thread applies another of the filters, or to another document, or if
    /// `callback` changes or deletes the layer.
    FilterOutcome (*apply)(MeshDocument& document, const RichParameterList& parameters,
                           vcg::CallBackPos* callback);
};

/// Passes each line of the message to `log`, the first after the name of the build. An empty
/// message has no line.
template <class Log>
void log_lines(const std::string& message, const Log& log) {
    if (message.empty()) return;
    std::istringstream lines(kBuild + (": " + message));
    for (std::string line; std::getline(lines, line);) log(line);
}

/// Returns the plugin's filters. Their places are MeshLab's identifiers of its actions.
const std::vector<MeshLabFilter>& meshlab_filters();

}  // namespace tracked_mcf
