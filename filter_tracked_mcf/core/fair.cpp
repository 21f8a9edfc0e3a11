// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/fair.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/fair/fairing.h"
#include "filter_tracked_mcf/core/fair/patches.h"
#include "filter_tracked_mcf/core/mesh/filter_run.h"
#include "filter_tracked_mcf/core/mesh/surface.h"
#include "filter_tracked_mcf/core/platform/process_memory.h"

namespace tracked_mcf {

namespace {

/// Bytes for each vertex and each triangle of the mesh, and for each vertex that moves.
constexpr double kBytesPerVertexOfPatches = 60, kBytesPerTriangleOfPatches = 90,
                 kBytesPerMoving[] = {1300, 3200, 6500};  // by continuity

/// Returns the positions of the patch's vertices, from the first one, so that coordinates are
/// small.
Fairing::Points points_of(const Patch& patch, const Surface& surface, const TriangleMesh& mesh,
                          double scale) {
    const Eigen::Vector3d& first = surface.in_mesh_units(mesh, patch.vertices[0]);
    Fairing::Points points(static_cast<Eigen::Index>(patch.vertices.size()), 3);
    for (Eigen::Index i = 0; i < points.rows(); ++i)
        points.row(i) = (surface.in_mesh_units(mesh, patch.vertices[i]) - first) / scale;
    return points;
}

/// Returns the number of selected triangles. Throws InvalidMesh if these are all.
std::int64_t count_selected(const TriangleMesh& mesh, const Selection& selection) {
    const auto not_selected = std::count(selection.begin(), selection.end(), 0);
    if (not_selected > 0) return static_cast<std::int64_t>(mesh.triangles.size()) - not_selected;
    throw InvalidMesh(
        "All faces are selected, so there is nothing around them to continue. Select the faces "
        "that fill the hole.");
}

/// Returns which vertices of the whole surface are inner ones of the selection, see fair().
std::vector<std::uint8_t> inner_vertices(const Surface& whole, const Surface& selected) {
    std::vector<std::uint8_t> are_inner(whole.mesh_vertices.size(), 0);
    for (std::size_t i = 0; i < selected.mesh_vertices.size(); ++i) {
        const std::int32_t vertex = whole.vertices[selected.mesh_vertices[i]];
        const bool on_rim = whole.stars.has_rim() && whole.stars.on_rim[vertex] != 0;
        if (selected.held[i] == 0 && !on_rim) are_inner[vertex] = 1;
    }
    return are_inner;
}

void check_memory(const TriangleMesh& mesh, std::int64_t selected, Continuity continuity) {
    check_free_memory(
        kBytesPerVertexOfPatches * static_cast<double>(mesh.positions.size()) +
            kBytesPerTriangleOfPatches * static_cast<double>(mesh.triangles.size()) +
            kBytesPerMoving[static_cast<int>(continuity)] / 2 * static_cast<double>(selected),
        "Fairing", "Select less, or simplify the mesh.");
}

/// Fairs patches, one after the other, and reports how.
class PatchMover {
public:
    PatchMover(const TriangleMesh& mesh, const Surface& surface, Continuity continuity,
               FairReport& report)
        : mesh_(mesh),
          surface_(surface),
          scale_(surface.box.sizes().maxCoeff()),
          continuity_(static_cast<int>(continuity)),
          report_(report) {}

    /// Sets how far the patch's vertices move, in mesh units.
    void move(const Patch& patch, Positions& movements) {
        const Fairing::Points before = points_of(patch, surface_, mesh_, scale_);
        Fairing fairing(patch, before);
        if (fairing.solve(continuity_) < continuity_) ++report_.flatter_patches;
        for (std::int32_t i = 0; i < patch.moving; ++i) {
            movements[patch.vertices[i]] =
                scale_ * (fairing.positions().row(i) - before.row(i)).transpose();
        }
        const auto [inside, around] = fairing.bending();
        if (continuity_ > 0 && fairing.is_rough(inside, around)) ++report_.rough_patches;
        inside_ += inside;
        around_ += around;
        report_.patch_curvature = inside_.curvature() / scale_;
        report_.seam_curvature = around_.curvature() / scale_;
        report_.height = std::max(report_.height, fairing.height());
        report_.passes = std::max(report_.passes, fairing.passes());
    }

private:
    const TriangleMesh& mesh_;
    const Surface& surface_;
    double scale_;  ///< longest side of the box, mesh units
    int continuity_;
    FairReport& report_;
    Bending inside_, around_;
};

}  // namespace

FairReport fair(TriangleMesh& mesh, const Selection& selection, const FairParameters& parameters,
                const Progress& progress) {
    validate(parameters);
    FilterRun run(parameters.threads, progress);
    enter_phase(0, "Finding the patches");
    validate(mesh, Inputs{selection, {}});
    FairReport report;
    check_memory(mesh, count_selected(mesh, selection), parameters.continuity);
    Surface whole = surface_of(mesh);
    const Surface selected = surface_of_selection(whole, mesh, selection);
    report_counts(selected.counts, report);
    const std::vector<Patch> patches = patches_of(whole.stars, inner_vertices(whole, selected));
    whole.stars = {};  // the patches have what they need of these
    report.patches = static_cast<std::int64_t>(patches.size());
    for (const Patch& patch : patches) report.vertices += patch.moving;

    PatchMover mover(mesh, whole, parameters.continuity, report);
    Positions movements(whole.positions.size(), Eigen::Vector3d::Zero());
    std::int64_t done = 0;
    for (const Patch& patch : patches) {
        enter_phase(0.1 + 0.85 * static_cast<double>(done) / static_cast<double>(report.vertices),
                    "Fairing");
        mover.move(patch, movements);
        done += patch.moving;
    }
    std::vector<Eigen::Vector3d> after = mesh.positions;
    for (std::size_t i = 0; i < after.size(); ++i) {
        const std::int32_t vertex = whole.vertices[i];
        // Adding 0 to -0 would change its bits.
        if (vertex >= 0 && !movements[vertex].isZero(0)) after[i] += movements[vertex];
    }
    report_change(mesh, after, selected, parameters.quality, report);
    run.finish(mesh, std::move(after), report);
    return report;
}

}  // namespace tracked_mcf
