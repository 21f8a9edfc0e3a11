#include "filter_tracked_mcf/parameters/parameter_table.h"

#include "filter_tracked_mcf/core/flow_parameters.h"

namespace tracked_mcf {

const char* const kFilterName = "Mean Curvature Flow";

const char* const kPythonFilterName = "apply_coord_mean_curvature_flow";

const char* const kFilterHelp =
    "Smooths the surface by <b>mean-curvature flow</b>: every point moves along the normal with "
    "the speed of the mean curvature, so that noise and small detail vanish first. Stable at any "
    "step size, and fast: finite elements from an octree are tracked as the surface moves, and "
    "solved by multigrid (Chuang and Kazhdan, <i>Fast Mean-Curvature Flow via Finite-Elements "
    "Tracking</i>, 2011).<br>Closed surfaces shrink, unless rescaled; sharp features are smoothed "
    "like noise. Only positions change.";

const std::vector<ParameterDescription>& parameter_table() {
    static const FlowParameters defaults;
    static const std::vector<ParameterDescription> table = {
        {"depth", "Octree depth",
         "Functions on a grid of 2^depth cells a side, 1 to 12: one more resolves detail twice as "
         "fine, for about four times the time. 0, best at first: about as many functions as "
         "vertices.",
         ParameterDescription::Integer{defaults.depth}},
        {"step_size", "Step size",
         "Time step, a squared length, where the model's longest side is 1. A step smooths away "
         "detail smaller than its square root: 1e-5 takes off bumps of 0.3 %. Larger smooths more "
         "and stays stable. Above 0, up to 1e9.",
         ParameterDescription::Real{defaults.step_size}},
        {"absolute", "Absolute step size",
         "The step size is in squared units of the mesh. Switch it on to remove detail of one size "
         "from models of any size.",
         ParameterDescription::Boolean{defaults.absolute}},
        {"iterations", "Iterations",
         "Number of steps, 1 to 1000000. More smooth further and take longer; many small ones are "
         "more accurate than a few large ones.",
         ParameterDescription::Integer{defaults.iterations}},
        {"flow", "Flow",
         "Mean curvature: thin parts pinch. Conformalized: nothing pinches, and closed surfaces "
         "without handles become spheres. It loses shape: take it with Keep area, to map to the "
         "sphere.",
         ParameterDescription::Choice{static_cast<int>(defaults.flow),
                                      {"Mean curvature", "Conformalized"}}},
        {"boundary", "Boundary",
         "Of an open mesh. Locked: rim vertices keep their place, the surface beside them moves. "
         "Locked cells: all in the grid cells along the rim stays. Free: openings shrink. Take "
         "Locked if in doubt.",
         ParameterDescription::Choice{static_cast<int>(defaults.boundary),
                                      {"Locked", "Locked cells (paper)", "Free"}}},
        {"selected", "Selected faces only",
         "Only selected faces move; vertices that others have keep their place. On at first if "
         "faces are selected. Select some more than needed: the seam is held.",
         ParameterDescription::SelectionSwitch{}},
        {"rescale", "Rescale",
         "After each step, scales about the centroid to the initial area or volume. The volume "
         "needs a closed, consistently oriented mesh, and nothing may be held. Keep volume, to "
         "smooth without shrinking.",
         ParameterDescription::Choice{static_cast<int>(defaults.rescale),
                                      {"None", "Keep area", "Keep volume"}}},
        {"separate_sheets", "Separate sheets",
         "Parts of the surface that share a grid cell but are not connected in it, such as two "
         "fingers, move each on its own. Leave it on, unless to compare with the paper.",
         ParameterDescription::Boolean{defaults.separate_sheets}},
        {"solver", "Solver",
         "Converged: each step is solved far below the grid's own error. One W-cycle (paper): by "
         "one multigrid cycle. Take Converged, unless to compare with the paper.",
         ParameterDescription::Choice{static_cast<int>(defaults.solver),
                                      {"Converged", "One W-cycle (paper)"}}},
    };
    return table;
}

}  // namespace tracked_mcf
