// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <variant>

#include "filter_tracked_mcf/core/errors.h"
#include "filter_tracked_mcf/core/evolve.h"
#include "filter_tracked_mcf/hosts/bridge/mesh_bridge.h"
#include "filter_tracked_mcf/presentation/run.h"

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

/// Wraps a host's callback, which may be null, for the core.
Progress as_progress(HostCallback* callback);

namespace run_filter_detail {

/// Returns a checksum of the bits of all positions and triangles.
std::uint64_t checksum(const TriangleMesh& mesh);

/// Returns the summary() of a run and its warnings, in lines.
template <class Parameters, class Report>
std::string message_of(const Parameters& parameters, const Report& report);

/// Returns the numbers of report_table(): 1 for yes, 0 for no, and NaN for null.
template <class Report>
Outputs outputs_of(const Report& report);

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

/// Applies the filter of these parameters to a mesh of any vcglib type, with inputs for the faces
/// and vertices that are not deleted, and returns the message for the user. It throws what the core
/// and `progress` throw, so call it under guard(). It writes nothing but positions and, if asked
/// for, the vertices' quality, and writes them last: a failure or a cancelled run leaves the mesh
/// as it was. Throws InvalidMesh if `progress` has changed a position or a face: a user may apply
/// other filters meanwhile. The host updates normals and bounding box.
template <class VcgMesh, class Parameters>
FilterOutcome run_filter(VcgMesh& mesh, const Parameters& parameters, const Inputs& inputs,
                         const Progress& progress) {
    using namespace run_filter_detail;
    TriangleMesh moved = to_triangle_mesh(mesh);
    const std::uint64_t before = checksum(moved);
    const auto report = run(moved, inputs, parameters, progress);
    if (checksum(to_triangle_mesh(mesh)) != before) {
        throw InvalidMesh(
            "The layer changed while the filter ran, so the result was not written. Apply the "
            "filter again.");
    }
    write_positions(moved, mesh);
    if (!report.quality.empty()) write_quality(report.quality, mesh);
    return {true, message_of(parameters, report), outputs_of(report)};
}

}  // namespace tracked_mcf
