// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/paper/transfer.h"

#include <algorithm>
#include <vector>

#include "filter_tracked_mcf/core/flow/solver/element_transfer.h"

namespace tracked_mcf {

SparseMatrix prolongation(const Level& fine, const Level& coarse) {
    const RefinementTable& table = refinement_table();
    SparseMatrix matrix(fine.unknown_count(), coarse.unknown_count());
    matrix.reserve(4 * static_cast<Eigen::Index>(fine.unknown_count()));
    // Unknowns are numbered in the order in which elements first have them.
    std::int32_t row = 0;
    std::vector<std::int32_t> columns;
    for (std::int32_t element = 0; element < fine.element_count(); ++element) {
        const auto& parent_unknowns = coarse.unknowns[fine.parents[element]];
        for (int i = 0; i < 8; ++i) {
            if (fine.unknowns[element][i] != row) continue;
            const ContainingFunctions& containing = table[octant_of(fine.cells[element])][i];
            columns.clear();
            for (int k = 0; k < containing.count; ++k) {
                columns.push_back(parent_unknowns[containing.corners[k]]);
            }
            std::sort(columns.begin(), columns.end());
            matrix.startVec(row);
            for (const std::int32_t column : columns) {
                matrix.insertBack(row, column) = containing.weight;
            }
            ++row;
        }
    }
    matrix.finalize();
    return matrix;
}

}  // namespace tracked_mcf
