#pragma once

#include <Eigen/Core>
#include <vector>

#include "filter_tracked_mcf/core/domain.h"
#include "filter_tracked_mcf/core/flow.h"
#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf {

/// Gives a flowing mesh its initial area or volume back after each step, by scaling it about its
/// surface's centroid.
class Rescaler {
public:
    /// For a flow of `mesh`, positions as they are now. Throws InvalidParameter if something of the
    /// mesh is held, which scaling would move; InvalidMesh if the volume is to be kept and there is
    /// none: the surface is open, its triangles are not oriented consistently, or it is flat.
    Rescaler(const TriangleMesh& mesh, const Selection& selection,
             const FlowParameters& parameters);

    /// Scales after a step. Returns false, having taken the step back, where it has left next to
    /// nothing to scale, or nothing but what has pinched.
    bool restore(Flow& flow);

private:
    double measure() const;  ///< what is kept, of moved_
    bool blows_up(double factor, const FlowReport& report) const;

    Rescaling kind_;
    FlowKind flow_;
    std::vector<Eigen::Vector3d> start_;
    TriangleMesh moved_;
    double initial_side_;  ///< longest side of the bounding box
    double initial_ = 0;   ///< what is kept, at the start
    double area_;          ///< after the last step
};

}  // namespace tracked_mcf
