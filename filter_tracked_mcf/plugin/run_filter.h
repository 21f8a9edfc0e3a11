#pragma once

#include <functional>
#include <map>
#include <string>
#include <variant>

#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/mesh_bridge/mesh_bridge.h"
#include "filter_tracked_mcf/plugin/parameter_values.h"

namespace tracked_mcf {

/// The progress callback of every release, vcg::CallBackPos; returning false asks to stop.
using HostCallback = bool(int percent, const char* phase);

/// Numbers that scripts can use, by name.
using Outputs = std::map<std::string, std::variant<int, double>>;

/// How a run of the filter ended.
struct FilterOutcome {
    bool succeeded;
    std::string message;  ///< for the user: what was done, or what is wrong and what to do
    Outputs outputs;      ///< of a success; see outputs_of()
};

/// What `work` returns; of what it throws, be it what it may, a failure with its message: no host
/// survives an exception that it does not know.
FilterOutcome guard(const std::function<FilterOutcome()>& work);

namespace run_filter_detail {

/// A host's callback, which may be null, as the core's.
Progress as_progress(HostCallback* callback);

/// The report in a few sentences.
std::string summary(const FlowParameters& parameters, const FlowReport& report);

/// The report in a few numbers: `unknowns`, `depth`, `steps` (those made), `final_residual` (of the
/// last step, relative to before it: what the solver's tolerance bounds, or with W-cycles the
/// 2-norm), `area_before` and `area_after` (of what flows, mesh units²).
Outputs outputs_of(const FlowParameters& parameters, const FlowReport& report);

}  // namespace run_filter_detail

/// The whole filter, for any host: flows a layer's mesh of any vcglib type and returns what to tell
/// the user; to be called under guard(), for it throws what the core throws. Positions are written
/// last, so a failure, or a callback that returns false, leaves the mesh as it was. Nothing else of
/// the mesh is touched; normals and bounding box are the host's to update.
template <class VcgMesh>
FilterOutcome run_filter(VcgMesh& mesh, const ParameterValues& values, HostCallback* callback) {
    using namespace run_filter_detail;
    const FlowParameters parameters = flow_parameters(values);
    const Selection selection = selected_only(values) ? selected_faces(mesh) : Selection();
    TriangleMesh moved = to_triangle_mesh(mesh);
    const FlowReport report = evolve(moved, selection, parameters, as_progress(callback));
    write_positions(moved, mesh);
    return {true, summary(parameters, report), outputs_of(parameters, report)};
}

}  // namespace tracked_mcf
