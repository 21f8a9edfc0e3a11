// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/drift.h"

#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

void remove_drift(const TrackedElements& elements, const MatrixBlocks& masses,
                  const std::vector<std::uint8_t>& constrained, Coefficients& step) {
    std::vector<double> mass(constrained.size(), 0);
    std::vector<Eigen::RowVector3d> drift(constrained.size(), Eigen::RowVector3d::Zero());
    for (std::int32_t element = 0; element < elements.finest().element_count(); ++element) {
        const std::int32_t component = elements.components.of_element[element];
        const ElementMatrix matrix = masses.of(element);
        for (int column = 0; column < 8; ++column) {
            double share = 0;
            for (const auto& row : matrix.entry) share += row[column];
            mass[component] += share;
            drift[component] += share * step.row(elements.finest().unknowns[element][column]);
        }
    }
    parallel_for_rows(elements.finest().unknown_count(), [&](std::int32_t unknown) {
        const std::int32_t component = elements.components.of_unknown[unknown];
        if (constrained[component] != 0 || !(mass[component] > 0)) return;
        step.row(unknown) -= drift[component] / mass[component];
    });
}

}  // namespace tracked_mcf
