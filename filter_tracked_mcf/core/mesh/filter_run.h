// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "filter_tracked_mcf/core/filter_report.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/mesh/surface.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"
#include "filter_tracked_mcf/core/parallel/stopwatch.h"
#include "filter_tracked_mcf/core/parallel/thread_team.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Sets what any report says of a surface.
void report_counts(const SurfaceCounts& counts, FilterReport& report);

/// Sets what the report of a filter that smooths says of it.
void report_surface(const Surface& surface, SmoothingReport& report);

/// Sets what a report says of a change, once the mesh's vertices are at `after`, and the quality if
/// it is the displacement. FilterReport::vertices must be set.
void report_change(const TriangleMesh& before, const std::vector<Eigen::Vector3d>& after,
                   const Surface& surface, Quality quality, FilterReport& report);

/// What every filter begins and ends with: while it lives, this thread has a team, and reports its
/// progress.
class FilterRun {
public:
    /// `progress` must outlive the run. Without a callback, progress goes to an outer meter.
    FilterRun(int threads, const Progress& progress);

    /// Moves the vertices, after a last call of the callback, and reports the time and the memory.
    void finish(TriangleMesh& mesh, std::vector<Eigen::Vector3d>&& after, FilterReport& report);

private:
    std::optional<ProgressMeter> meter_;
    ThreadTeam team_;
    Stopwatch watch_;
};

}  // namespace tracked_mcf
