// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <map>
#include <string>
#include <variant>

#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/mesh_bridge/mesh_bridge.h"
#include "filter_tracked_mcf/plugin/parameter_values.h"

namespace tracked_mcf {

/// The progress callback of every release, vcg::CallBackPos. It returns false to cancel.
using HostCallback = bool(int percent, const char* phase);

/// Numbers that scripts can use, by name.
using Outputs = std::map<std::string, std::variant<int, double>>;

/// How a run of the filter ended.
struct FilterOutcome {
    bool succeeded;
    std::string message;  ///< for the user: what was done, or what is wrong and what to do
    Outputs outputs;      ///< empty after a failure; see outputs_of()
};

/// Runs `work` and turns any exception into a failed outcome: an exception that a host does not
/// know ends its program. The message about a parameter says its label in the dialog, too.
FilterOutcome guard(const std::function<FilterOutcome()>& work);

namespace run_filter_detail {

/// Wraps a host's callback, which may be null, for the core.
Progress as_progress(HostCallback* callback);

/// Describes the report in a few sentences.
std::string summary(const FlowParameters& parameters, const FlowReport& report);

/// Returns, in units of the mesh and of the surface that flows:
/// - `detail_size`, `step_size` (δ), `depth`, `cell_size`, `unknowns`,
/// - `steps` (the number made), `stopped_early` (1 or 0), `converged` (1 if all steps reached the
///   tolerance, else 0), `error_estimate` (of the last step: the relative error in the energy norm,
///   or with W-cycles the relative 2-norm of the residual),
/// - `largest_displacement`, `rms_displacement` (of the vertices),
/// - `area_before`, `area_after`, and, if the faces are oriented consistently, `volume_change`.
Outputs outputs_of(const FlowParameters& parameters, const FlowReport& report);

/// Returns default_detail_size(), or 0 if the mesh is not valid.
double default_detail_size_or_zero(const TriangleMesh& mesh, const Selection& selection);

}  // namespace run_filter_detail

/// Returns the default detail size of a mesh's selected faces, or of all if none is selected, in
/// units of the mesh; 0 if the mesh cannot flow.
template <class VcgMesh>
double default_detail_size_of(const VcgMesh& mesh) {
    const Selection selection = has_selected_faces(mesh) ? selected_faces(mesh) : Selection();
    return run_filter_detail::default_detail_size_or_zero(to_triangle_mesh(mesh), selection);
}

/// Flows a mesh of any vcglib type and returns the message for the user. It throws what the core
/// throws, so call it under guard(). It writes nothing but positions and, if asked for, the
/// vertices' quality, and writes them last: a failure or a cancelled run leaves the mesh as it was.
/// The host updates normals and bounding box.
template <class VcgMesh>
FilterOutcome run_filter(VcgMesh& mesh, const ParameterValues& values, HostCallback* callback) {
    using namespace run_filter_detail;
    const FlowParameters parameters = flow_parameters(values);
    const Selection selection = selected_only(values) ? selected_faces(mesh) : Selection();
    TriangleMesh moved = to_triangle_mesh(mesh);
    const FlowReport report = evolve(moved, selection, parameters, as_progress(callback));
    write_positions(moved, mesh);
    if (!report.quality.empty()) write_quality(report.quality, mesh);
    return {true, summary(parameters, report), outputs_of(parameters, report)};
}

}  // namespace tracked_mcf
