#include "filter_tracked_mcf/parameters/parameter_table.h"

#include "filter_tracked_mcf/core/flow_parameters.h"

namespace tracked_mcf {

const char* const kFilterName = "Mean Curvature Flow";

const char* const kFilterHelp =
    "Smooths the surface by <b>mean-curvature flow</b>: every point moves along the normal with "
    "the speed of the mean curvature, so that noise and small detail vanish first and large "
    "shapes last. The steps are semi-implicit, hence stable at any size, and fast: finite "
    "elements from an octree are restricted to the surface, tracked as it moves, and solved by "
    "multigrid (Chuang and Kazhdan, <i>Fast Mean-Curvature Flow via Finite-Elements "
    "Tracking</i>, 2011).<br>Closed surfaces shrink, and thin parts pinch. Sharp features are "
    "smoothed like noise; this is not a feature-preserving denoiser. Only positions change: "
    "faces, colours, texture coordinates and selection stay.";

const std::vector<ParameterDescription>& parameter_table() {
    static const FlowParameters defaults;
    static const std::vector<ParameterDescription> table = {
        {"depth", "Octree depth",
         "The surface moves with functions on a grid of 2^depth cells a side. One more halves "
         "the cells: detail twice as fine is resolved, with about four times the unknowns, time "
         "and memory. 0 chooses the depth with about as many unknowns as the mesh has vertices; "
         "else 1 to 12.",
         ParameterDescription::Integer{defaults.depth}},
        {"step_size", "Step size",
         "Time step of the flow, a squared length, for the model scaled so that the longest side "
         "of its bounding box is 1. A step smooths away detail smaller than about its square "
         "root: 1e-5 takes off bumps of about 0.3 % of the model's size. Larger smooths more in "
         "each step, less accurately in time, and stays stable. Greater than 0, at most 1e9.",
         ParameterDescription::Real{defaults.step_size}},
        {"iterations", "Iterations",
         "Number of steps, 1 to 1000000. More smooth further, each from where the last one "
         "ended; the time grows in proportion. The total flow time is step size times "
         "iterations.",
         ParameterDescription::Integer{defaults.iterations}},
        {"boundary", "Boundary",
         "What happens at the rim of an open mesh. Locked cells: everything in a grid cell that "
         "the rim passes through keeps its place, and the cells beside it follow less; a greater "
         "depth makes that band narrower. Free: nothing is held, so openings shrink and open "
         "meshes degenerate quickly.",
         ParameterDescription::Choice{static_cast<int>(defaults.boundary),
                                      {"Locked cells", "Free"}}},
        {"separate_sheets", "Separate sheets",
         "Parts of the surface that share a grid cell but are not connected in it, such as two "
         "fingers or the two sides of a thin plate, move each on its own. Off, as in the paper, "
         "they stick together. Leave it on, unless to compare with the paper.",
         ParameterDescription::Boolean{defaults.separate_sheets}},
        {"solver", "Solver",
         "How far each step's equations are solved. Converged: until the error is far below the "
         "grid's own; a step that does not get there is reported. One W-cycle (paper): by one "
         "multigrid cycle, however far that comes. Take Converged, unless to compare with the "
         "paper.",
         ParameterDescription::Choice{static_cast<int>(defaults.solver),
                                      {"Converged", "One W-cycle (paper)"}}},
    };
    return table;
}

}  // namespace tracked_mcf
