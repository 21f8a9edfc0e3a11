// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/fair.h"

#include "filter_tracked_mcf/core/parameters/parameter_rows.h"

namespace tracked_mcf {

template <>
const std::vector<ParameterOf<FairParameters>>& parameter_table() {
    using namespace parameter_rows;
    using P = FairParameters;
    static const std::vector<ParameterOf<P>> table = {
        named(choice<&P::continuity>({{"Position (C0)", "position"},
                                      {"Tangent (C1)", "tangent"},
                                      {"Curvature (C2)", "curvature"}}),
              "continuity", "Continuity",
              "What the patch shares with its surroundings. Position suits rough ones, curvature "
              "smooth ones."),
        displacement<&P::quality>(),
        threads<&P::threads>(),
    };
    return table;
}

template <>
const std::vector<Input>& input_table<FairParameters>() {
    static const std::vector<Input> table = [] {
        Input row = parameter_rows::selected(
            "The faces around them stay, and so does the rim of an open mesh.");
        row.label.clear();  // dialogs have no choice to offer
        return std::vector<Input>{row};
    }();
    return table;
}

void validate(const FairParameters& parameters) {
    check_ranges(parameters);
}

}  // namespace tracked_mcf
