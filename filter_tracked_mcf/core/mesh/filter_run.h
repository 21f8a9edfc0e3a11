// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "filter_tracked_mcf/core/filter_report.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/mesh/domain.h"
#include "filter_tracked_mcf/core/parallel/progress_meter.h"
#include "filter_tracked_mcf/core/parallel/stopwatch.h"
#include "filter_tracked_mcf/core/parallel/thread_team.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// The part of a mesh that a filter moves, as its report counts it.
struct MovingPart {
    Selection triangles;                 ///< of the mesh; empty is all
    std::vector<std::uint8_t> vertices;  ///< flags of one copy of each vertex
    bool is_oriented = false;            ///< consistently
    bool encloses_volume = false;        ///< see Domain::encloses_volume()
};

/// Returns the surface of a domain as a part of its mesh.
MovingPart moving_part_of(const Domain& domain);

/// Sets what a report says of a domain. Throws InvalidMesh if no triangle has an area.
void report_domain(const Domain& domain, SmoothingReport& report);

/// Sets what a report says of a change, once the mesh's vertices are at `after`, and the quality if
/// it is the displacement.
void report_change(const TriangleMesh& before, const std::vector<Eigen::Vector3d>& after,
                   const MovingPart& part, Quality quality, FilterReport& report);

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
