#include "filter_tracked_mcf/core/galerkin.h"

#include "filter_tracked_mcf/core/kernels/kernels.h"
#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

namespace {

void leave_out(MatrixBlocks& matrices, std::int32_t element, int corner) {
    for (int i = 0; i < 8; ++i) matrices.at(element, corner, i) = 0;
}

}  // namespace

void coarsen_element_matrices(const Level& fine, const Groups& children,
                              const MatrixBlocks& fine_matrices, MatrixBlocks& coarse_matrices) {
    const ChildElements elements = {fine_matrices.blocks(), fine.cells.data(), children.items(),
                                    children.begins()};
    parallel_for_blocks(coarse_matrices.size(), [&](std::int64_t begin, std::int64_t end) {
        kernels().coarsen_elements(elements, static_cast<std::int32_t>(begin),
                                   static_cast<std::int32_t>(end), coarse_matrices.blocks());
    });
}

void leave_out_frozen(const Level& level, const std::vector<std::uint8_t>& frozen,
                      MatrixBlocks& matrices) {
    parallel_for_rows(level.element_count(), [&](std::int32_t element) {
        for (int corner = 0; corner < 8; ++corner) {
            if (frozen[level.unknowns[element][corner]] != 0) leave_out(matrices, element, corner);
        }
    });
}

}  // namespace tracked_mcf
