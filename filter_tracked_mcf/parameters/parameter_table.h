#pragma once

#include <string>
#include <variant>
#include <vector>

namespace tracked_mcf {

/// One parameter of the filter, for a person and for every host: the plugin's dialogs and scripts
/// and the command-line tool are all made from this table, so they cannot disagree.
struct ParameterDescription {
    struct Integer {
        int default_value;
    };
    struct Real {
        double default_value;
    };
    struct Boolean {
        bool default_value;
    };
    /// A Boolean whose default is to be on when some faces of the mesh are selected.
    struct SelectionSwitch {};
    struct Choice {
        int default_value;  ///< index into labels
        std::vector<std::string>
            labels;  ///< as a dialog shows them, such as "Locked cells (paper)"
    };

    std::string name;     ///< in scripts: lower case and underscores, never changes
    std::string label;    ///< in a dialog
    std::string tooltip;  ///< what it means, its units, and what to give it
    std::variant<Integer, Real, Boolean, SelectionSwitch, Choice> type;
};

/// The filter's name in menus and scripts.
extern const char* const kFilterName;

/// Its name in PyMeshLab, where what moves vertices is called apply_coord_…
extern const char* const kPythonFilterName;

/// What the filter does, when to use it and when not, for its help; HTML as MeshLab shows it.
extern const char* const kFilterHelp;

/// The parameters in the order in which a dialog shows them; the defaults are FlowParameters' own.
const std::vector<ParameterDescription>& parameter_table();

}  // namespace tracked_mcf
