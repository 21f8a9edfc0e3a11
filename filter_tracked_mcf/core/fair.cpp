// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/fair.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "filter_tracked_mcf/core/fair/fairing.h"
#include "filter_tracked_mcf/core/fair/patches.h"
#include "filter_tracked_mcf/core/mesh/filter_run.h"
#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/platform/process_memory.h"

namespace tracked_mcf {

namespace {

/// Bytes for each vertex and each triangle of the mesh, and for each vertex that moves.
constexpr double kBytesPerVertexOfPatches = 60, kBytesPerTriangleOfPatches = 90,
                 kBytesPerMoving[] = {1300, 3200, 6500};  // by continuity

/// Returns the positions of the patch's vertices, from the first one, so that coordinates are
/// small.
Fairing::Points points_of(const Patch& patch, const TriangleMesh& mesh, double scale) {
    Fairing::Points points(static_cast<Eigen::Index>(patch.vertices.size()), 3);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        points.row(i) =
            (mesh.positions[patch.vertices[i]] - mesh.positions[patch.vertices[0]]) / scale;
    }
    return points;
}

/// Returns the selected triangles. Throws InvalidMesh if these are all.
std::vector<Triangle> selected_triangles(const TriangleMesh& mesh, const Selection& selection) {
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < selection.size(); ++i) {
        if (selection[i] != 0) triangles.push_back(mesh.triangles[i]);
    }
    if (!selection.empty() && triangles.size() < mesh.triangles.size()) return triangles;
    throw InvalidMesh(
        "All faces are selected, so there is nothing around them to continue. Select the faces "
        "that fill the hole.");
}

void check_memory(const TriangleMesh& mesh, std::int64_t selected, Continuity continuity) {
    check_free_memory(
        kBytesPerVertexOfPatches * static_cast<double>(mesh.positions.size()) +
            kBytesPerTriangleOfPatches * static_cast<double>(mesh.triangles.size()) +
            kBytesPerMoving[static_cast<int>(continuity)] / 2 * static_cast<double>(selected),
        "Fairing", "Select less, or simplify the mesh.");
}

/// Moves the vertices of patches, one patch after the other, and reports how.
class PatchMover {
public:
    PatchMover(const TriangleMesh& mesh, Continuity continuity, FairReport& report)
        : mesh_(mesh),
          scale_(longest_side(mesh)),
          continuity_(static_cast<int>(continuity)),
          report_(report) {}

    void move(const Patch& patch, std::vector<Eigen::Vector3d>& positions) {
        const Fairing::Points before = points_of(patch, mesh_, scale_);
        Fairing fairing(patch, before);
        if (fairing.solve(continuity_) < continuity_) ++report_.flatter_patches;
        for (std::int32_t i = 0; i < patch.moving; ++i) {
            positions[patch.vertices[i]] +=
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
    double scale_;
    int continuity_;
    FairReport& report_;
    Bending inside_, around_;
};

/// Moves the copies of vertices with them.
void move_copies(const std::vector<std::int32_t>& welded,
                 const std::vector<Eigen::Vector3d>& before, std::vector<Eigen::Vector3d>& after) {
    for (std::size_t i = 0; i < after.size(); ++i) {
        const Eigen::Vector3d moved = after[welded[i]] - before[welded[i]];
        // Adding 0 to -0 would change its bits.
        if (welded[i] != static_cast<std::int32_t>(i) && !moved.isZero(0)) after[i] += moved;
    }
}

}  // namespace

FairReport fair(TriangleMesh& mesh, const Selection& selection, const FairParameters& parameters,
                const Progress& progress) {
    validate(parameters);
    FilterRun run(parameters.threads, progress);
    enter_phase(0, "Finding the patches");
    validate(mesh, Inputs{selection, {}});
    FairReport report;
    {
        const std::vector<Triangle> selected = selected_triangles(mesh, selection);
        report.triangles = static_cast<std::int64_t>(selected.size());
        report.degenerate_triangles = count_degenerate({mesh.positions, selected});
    }
    check_memory(mesh, report.triangles, parameters.continuity);
    PatchMover mover(mesh, parameters.continuity, report);
    MeshTopology topology = topology_of(mesh);
    const std::vector<Patch> patches = patches_of(topology, selection);
    const std::vector<std::int32_t> welded = std::move(topology.welded);
    report.cracks = topology.cracks;
    MovingPart part{selection, std::vector<std::uint8_t>(mesh.positions.size(), 0),
                    topology.is_oriented_consistently(), false};
    topology = {};
    report.patches = static_cast<std::int64_t>(patches.size());
    for (const Patch& patch : patches) {
        report.vertices += patch.moving;
        for (std::int32_t i = 0; i < patch.moving; ++i) part.vertices[patch.vertices[i]] = 1;
    }

    std::vector<Eigen::Vector3d> after = mesh.positions;
    std::int64_t done = 0;
    for (const Patch& patch : patches) {
        enter_phase(0.1 + 0.85 * static_cast<double>(done) / static_cast<double>(report.vertices),
                    "Fairing");
        mover.move(patch, after);
        done += patch.moving;
    }
    move_copies(welded, mesh.positions, after);
    report_change(mesh, after, part, parameters.quality, report);
    run.finish(mesh, std::move(after), report);
    return report;
}

}  // namespace tracked_mcf
