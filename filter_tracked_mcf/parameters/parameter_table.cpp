#include "filter_tracked_mcf/parameters/parameter_table.h"

#include "filter_tracked_mcf/core/flow_parameters.h"

namespace tracked_mcf {

const char* const kFilterName = "Mean Curvature Flow";

const char* const kFilterHelp =
    "Smooths the surface by <b>mean-curvature flow</b>: every point moves along the normal with "
    "the speed of the mean curvature, so that noise and small detail vanish first and large "
    "shapes last. The steps are implicit, hence stable at any size, and fast: finite elements from "
    "an octree are tracked as the surface moves, and solved by multigrid (Chuang and Kazhdan, "
    "<i>Fast Mean-Curvature Flow via Finite-Elements Tracking</i>, 2011).<br>Closed surfaces "
    "shrink, unless rescaled, and thin parts pinch. Sharp features are smoothed like noise. Only "
    "positions change: faces, colours, texture coordinates and selection stay.";

const std::vector<ParameterDescription>& parameter_table() {
    static const FlowParameters defaults;
    static const std::vector<ParameterDescription> table = {
        {"depth", "Octree depth",
         "Functions on a grid of 2^depth cells a side move the surface. One more resolves detail "
         "twice as fine, for about four times the time and memory. 1 to 12; or 0, which suits most "
         "meshes: about as many functions as vertices.",
         ParameterDescription::Integer{defaults.depth}},
        {"step_size", "Step size",
         "Time step, a squared length, for the model scaled so that its longest side is 1. A step "
         "smooths away detail smaller than about its square root: 1e-5 takes off bumps of 0.3 % "
         "of the model's size. Larger smooths more and stays stable. Greater than 0, at most 1e9.",
         ParameterDescription::Real{defaults.step_size}},
        {"absolute", "Absolute step size",
         "The step size is in squared units of the mesh as it is, not scaled. Switch it on to "
         "smooth away detail of the same size on models of different sizes.",
         ParameterDescription::Boolean{defaults.absolute}},
        {"iterations", "Iterations",
         "Number of steps, 1 to 1000000. More smooth further; the time grows in proportion. Many "
         "small steps are more accurate than a few large ones.",
         ParameterDescription::Integer{defaults.iterations}},
        {"flow", "Flow",
         "Mean curvature: thin parts pinch. Conformalized: nothing pinches, and closed surfaces "
         "without handles become spheres, for it loses shape rather than keeps it; take it with "
         "Keep area, to map a surface to the sphere.",
         ParameterDescription::Choice{static_cast<int>(defaults.flow),
                                      {"Mean curvature", "Conformalized"}}},
        {"boundary", "Boundary",
         "What happens at the rim of an open mesh. Locked: its vertices keep their place, and the "
         "surface beside them moves. Locked cells: all in the grid cells along it keeps its place. "
         "Free: nothing is held, so openings shrink. Take Locked, unless the rim is to move.",
         ParameterDescription::Choice{static_cast<int>(defaults.boundary),
                                      {"Locked", "Locked cells (paper)", "Free"}}},
        {"selected", "Selected faces only",
         "Only selected faces move; all vertices that others have keep their place. On at first "
         "if faces are selected. Select some more than is to be smoothed, for the seam is held.",
         ParameterDescription::SelectionSwitch{}},
        {"rescale", "Rescale",
         "After each step, scales about the surface's centroid to the area or volume it had at "
         "first. Keep volume needs a closed, consistently oriented mesh, and both need that "
         "nothing "
         "is held. Take Keep volume to smooth a closed scan without shrinking it.",
         ParameterDescription::Choice{static_cast<int>(defaults.rescale),
                                      {"None", "Keep area", "Keep volume"}}},
        {"separate_sheets", "Separate sheets",
         "Parts of the surface that share a grid cell but are not connected in it, such as two "
         "fingers, move each on its own. Off, as in the paper, they stick together. Leave it on, "
         "unless to compare with the paper.",
         ParameterDescription::Boolean{defaults.separate_sheets}},
        {"solver", "Solver",
         "Converged: each step's equations are solved until the error is far below the grid's own. "
         "One W-cycle (paper): by one multigrid cycle, however far that comes. Take Converged, "
         "unless to compare with the paper.",
         ParameterDescription::Choice{static_cast<int>(defaults.solver),
                                      {"Converged", "One W-cycle (paper)"}}},
    };
    return table;
}

}  // namespace tracked_mcf
