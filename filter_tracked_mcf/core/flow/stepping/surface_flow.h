// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "filter_tracked_mcf/core/flow/plan/plan.h"
#include "filter_tracked_mcf/core/flow_report.h"
#include "filter_tracked_mcf/core/mesh/filter_run.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// A surface whose area is below this fraction of its initial area has vanished.
inline constexpr double kVanishedArea = 1e-3;

/// A flow of a surface: set up once, then advanced step by step. Hosts call evolve(), which
/// validates the input, reports progress and writes the result back.
class SurfaceFlow {
public:
    SurfaceFlow(const SurfaceFlow&) = delete;
    SurfaceFlow& operator=(const SurfaceFlow&) = delete;
    virtual ~SurfaceFlow() = default;

    /// Makes one step and restores what is preserved.
    ///
    /// Returns false and keeps the state if the step fails; report().stop then says why. Where the
    /// previous step has left almost no area, this step undoes it instead, and returns false.
    ///
    /// Throws what poll_progress() throws; the flow cannot be continued then.
    virtual bool step() = 0;

    /// Takes the flow back to before the last step and ends it, with `reason` as report().stop.
    /// Call it at most once after a step.
    void end_before_last_step(Stop reason);

    /// Moves vertices from their initial positions to where the flow has brought them. `positions`
    /// are those of the mesh that the flow was made from. Vertices that do not move keep their
    /// bits.
    virtual void move_vertices(std::vector<Eigen::Vector3d>& positions) const = 0;

    /// Returns the mean curvature at each vertex of the mesh, see mean_curvatures_of(). `after` has
    /// the present positions of the mesh's vertices.
    virtual std::vector<double> mean_curvatures(const Positions& after) = 0;

    const FlowReport& report() const { return report_; }
    /// Returns the surface that flows. A flow may have taken its positions.
    const Surface& surface() const { return surface_; }

protected:
    /// Takes the plan's surface, and sets what the report says of the plan.
    explicit SurfaceFlow(Plan& plan);

    const TriangleMesh& mesh_;
    Surface surface_;
    FlowReport report_;

private:
    virtual void take_last_step_back() = 0;
};

}  // namespace tracked_mcf
