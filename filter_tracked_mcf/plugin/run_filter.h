#pragma once

#include <functional>
#include <string>

#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/mesh_bridge/mesh_bridge.h"
#include "filter_tracked_mcf/plugin/parameter_values.h"

namespace tracked_mcf {

/// The progress callback of every release, vcg::CallBackPos; returning false asks to stop.
using HostCallback = bool(int percent, const char* phase);

/// How a run of the filter ended.
struct FilterOutcome {
    bool succeeded;
    std::string message;  ///< for the user: what was done, or what is wrong and what to do
};

/// What `work` returns as the message of a success; what it throws, be it what it may, as that of a
/// failure: no host survives an exception.
FilterOutcome guard(const std::function<std::string()>& work);

namespace run_filter_detail {

/// A host's callback, which may be null, as the core's.
Progress as_progress(HostCallback* callback);

/// The report in a few sentences.
std::string summary(const FlowParameters& parameters, const FlowReport& report);

}  // namespace run_filter_detail

/// The whole filter, for any host: flows a layer's mesh of any vcglib type and returns what to tell
/// the user; to be called under guard(), for it throws what the core throws. Positions are written
/// last, so a failure, or a callback that returns false, leaves the mesh as it was. Nothing else of
/// the mesh is touched; normals and bounding box are the host's to update.
template <class VcgMesh>
std::string run_filter(VcgMesh& mesh, const ParameterValues& values, HostCallback* callback) {
    using namespace run_filter_detail;
    const FlowParameters parameters = flow_parameters(values);
    const Selection selection = selected_only(values) ? selected_faces(mesh) : Selection();
    TriangleMesh moved = to_triangle_mesh(mesh);
    const FlowReport report = evolve(moved, selection, parameters, as_progress(callback));
    write_positions(moved, mesh);
    return summary(parameters, report);
}

}  // namespace tracked_mcf
