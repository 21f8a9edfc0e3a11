// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "filter_tracked_mcf/core/flow_parameters.h"
#include "filter_tracked_mcf/core/triangle_mesh.h"

namespace tracked_mcf::experiments {

/// What a flow has cost so far. Seconds are processor time, which a busy machine hardly changes.
struct MethodReport {
    int depth = 0;              ///< 0 without an octree
    std::int64_t unknowns = 0;  ///< of the finest level, in the last step
    std::int64_t split_triangles = 0;
    double setup_seconds = 0;       ///< all set-ups: one if tracked, else one a step
    double assemble_seconds = 0;    ///< the linear systems of all steps
    double solve_seconds = 0;       ///< their solutions
    double residual = 0;            ///< of the last step, relative to that before the solve
    int iterations = 0;             ///< of all steps
    double collapsed = 0;           ///< share of the samples whose area has collapsed
    bool reached_tolerance = true;  ///< in the last step
};

/// One of the flows that section 5.2 of the paper compares, advanced step by step.
class Method {
public:
    virtual ~Method() = default;
    /// Makes one step. Returns false if the flow has ended.
    virtual bool step() = 0;
    /// Moves the mesh that the flow was made from to where it has come.
    virtual void move(TriangleMesh& mesh) const = 0;
    virtual MethodReport report() const = 0;
};

/// Returns the flow of this name:
///
///   tracked        the flow that the parameters ask for, see make_flow()
///   rebuilt        the paper's, with new elements from the present surface before each step
///                  (Chuang et al. 2009), on the octree's initial cube
///   rebuilt-split  the same, after every triangle was split into four
///   monte-carlo-N  the paper's, with N samples of each element, drawn at random from all of them;
///                  the boundary is free (section 5.5)
///   cotangent      linear elements on the triangles (Dziuk 1991), see CotangentFlow
///
/// Throws std::invalid_argument for any other name.
std::unique_ptr<Method> make_method(const std::string& name, const TriangleMesh& mesh,
                                    const FlowParameters& parameters);

}  // namespace tracked_mcf::experiments
