// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/parameters/parameter_table.h"

#include "filter_tracked_mcf/core/flow_parameters.h"

namespace tracked_mcf {

const std::vector<ParameterDescription>& parameter_table() {
    static const FlowParameters defaults;
    static const std::vector<ParameterDescription> table = {
        {"detail_size", "Remove detail smaller than",
         "Waves of this length keep half their height after all steps, shorter ones less. 0 takes "
         "2.5 mean edge lengths.",
         ParameterDescription::Length{}},
        {"local_detail_size", "Larger where faces are larger",
         "The length follows the local edge length, as noise of scans does.",
         ParameterDescription::Boolean{defaults.local_detail_size}},
        {"iterations", "Smoothing steps",
         "Steps in which the detail is removed, 1 to 1000000. More are more accurate.",
         ParameterDescription::Integer{defaults.iterations}},
        {"order", "Shape",
         "How well detail larger than that is kept. Each order more takes another solve in each "
         "step.",
         ParameterDescription::Choice{
             defaults.order - 1,
             {"Flow (order 1)", "Kept (order 2)", "Kept better (order 3)", "Kept best (order 4)"}}},
        {"preserve", "Preserve",
         "Of each connected part. Volume also works with boundaries and selections. Area scales, "
         "so nothing may be locked.",
         ParameterDescription::Choice{static_cast<int>(defaults.preserve),
                                      {"None", "Area", "Volume"}}},
        {"boundary", "Boundary",
         "Of an open mesh. Locked: its vertices stay. Locked cells: all in its grid cells stays. "
         "Free: openings shrink.",
         ParameterDescription::Choice{static_cast<int>(defaults.boundary),
                                      {"Locked", "Locked cells (paper)", "Free"}}},
        {"selected", "Affect only selected faces",
         "Vertices of other faces stay. Select a little more than needed, because the seam cannot "
         "move.",
         ParameterDescription::SelectionSwitch{}},
        {"quality", "Vertex quality",
         "For colours: how far the vertex moved along its normal, or the mean curvature after "
         "smoothing.",
         ParameterDescription::Choice{static_cast<int>(defaults.quality),
                                      {"Kept", "Displacement", "Mean curvature"}}},
        {"step_size", "Step size (expert)",
         "Time step, a squared length, for longest side 1. 0 takes that of the detail size.",
         ParameterDescription::Real{defaults.step_size}},
        {"absolute", "Absolute step size (expert)",
         "The step size is in squared units of the mesh.",
         ParameterDescription::Boolean{defaults.absolute}},
        {"depth", "Octree depth (expert)",
         "2^depth grid cells a side, 1 to 12; one more takes four times as long. 0 takes about as "
         "many functions as vertices.",
         ParameterDescription::Integer{defaults.depth}},
        {"flow", "Flow (expert)",
         "Mean curvature: thin parts pinch. Conformalized: becomes a sphere.",
         ParameterDescription::Choice{static_cast<int>(defaults.flow),
                                      {"Mean curvature", "Conformalized"}}},
        {"separate_sheets", "Separate sheets (expert)",
         "Parts that only share grid cells move independently. Off is as in the paper.",
         ParameterDescription::Boolean{defaults.separate_sheets}},
        {"solver", "Solver (expert)",
         "Converged: solves each step. One W-cycle: one multigrid cycle, only to compare with the "
         "paper.",
         ParameterDescription::Choice{static_cast<int>(defaults.solver),
                                      {"Converged", "One W-cycle (paper)"}}},
    };
    return table;
}

}  // namespace tracked_mcf
