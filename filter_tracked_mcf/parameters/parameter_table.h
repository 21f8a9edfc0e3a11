// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace tracked_mcf {

/// One parameter of the filter. The plugin's dialogs and scripts and the command-line tool take it
/// from the same table.
struct ParameterDescription {
    struct Integer {
        int default_value;
    };
    struct Real {
        double default_value;
    };
    /// A Real in units of the mesh that a dialog also shows in per cent of the bounding box's
    /// diagonal. The default depends on the mesh.
    struct Length {};
    struct Boolean {
        bool default_value;
    };
    /// A Boolean that is on by default if some faces of the mesh are selected.
    struct SelectionSwitch {};
    struct Choice {
        int default_value;                ///< index into labels
        std::vector<std::string> labels;  ///< in a dialog, such as "Locked cells (paper)"
    };

    std::string name;     ///< in scripts; lower case with underscores; never changes
    std::string label;    ///< in a dialog
    std::string tooltip;  ///< its meaning, its unit, and advice
    std::variant<Integer, Real, Length, Boolean, SelectionSwitch, Choice> type;
};

/// The filter's name in menus and scripts.
inline constexpr const char* kFilterName = "Mean Curvature Flow";

/// The filter's name in PyMeshLab, where names of filters that move vertices begin with
/// apply_coord.
inline constexpr const char* kPythonFilterName = "apply_coord_mean_curvature_flow";

/// The filter's help in the HTML that MeshLab shows.
inline constexpr const char* kFilterHelp =
    "Smooths the surface by <b>mean-curvature flow</b>, which removes noise and detail below a "
    "chosen size. Sharp features are smoothed like noise. Only positions and, if asked for, vertex "
    "qualities change.<br>See Ming Chuang and Michael Kazhdan: <b>Fast Mean-Curvature Flow via "
    "Finite-Elements Tracking</b>, 2011, <a "
    "href=\"https://doi.org/10.1111/j.1467-8659.2011.01899.x\">"
    "doi:10.1111/j.1467-8659.2011.01899.x</a>.";

/// Returns the parameters in the order of a dialog, with the defaults of FlowParameters.
const std::vector<ParameterDescription>& parameter_table();

}  // namespace tracked_mcf
