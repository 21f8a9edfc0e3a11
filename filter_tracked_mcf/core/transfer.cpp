#include "filter_tracked_mcf/core/transfer.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include "filter_tracked_mcf/core/bspline.h"
#include "filter_tracked_mcf/core/interruptible.h"

namespace tracked_mcf {

namespace {

/// Where an unknown can be found: as this corner of this element (any of several).
struct Home {
    std::int32_t element;
    int corner;
};

std::vector<Home> homes_of_unknowns(const Level& level) {
    std::vector<Home> homes(static_cast<std::size_t>(level.unknown_count()));
    serial_for(level.element_count(), [&](std::int64_t element) {
        for (int corner = 0; corner < 8; ++corner) {
            homes[level.unknowns[element][corner]] = {static_cast<std::int32_t>(element), corner};
        }
    });
    return homes;
}

/// Of a fine function, the coarse ones that contain it; all with the same weight, 1 / size.
struct CoarseFunctions {
    int size = 0;
    std::array<std::int32_t, 8> unknowns;
};

CoarseFunctions coarse_functions(const Level& fine, const Level& coarse, const Home& home,
                                 const std::array<Eigen::Matrix<double, 8, 8>, 8>& weights) {
    const auto& parent_unknowns = coarse.unknowns[fine.parents[home.element]];
    const auto& octant_weights = weights[octant_of(fine.cells[home.element])];
    CoarseFunctions functions;
    functions.unknowns.fill(std::numeric_limits<std::int32_t>::max());
    for (int corner = 0; corner < 8; ++corner) {
        if (octant_weights(home.corner, corner) == 0) continue;
        functions.unknowns[functions.size++] = parent_unknowns[corner];
    }
    std::sort(functions.unknowns.begin(), functions.unknowns.end());
    return functions;
}

}  // namespace

SparseMatrix prolongation(const Level& fine, const Level& coarse) {
    std::array<Eigen::Matrix<double, 8, 8>, 8> weights;
    for (int octant = 0; octant < 8; ++octant) weights[octant] = refinement_weights(octant);

    SparseMatrix matrix(fine.unknown_count(), coarse.unknown_count());
    matrix.reserve(4 * static_cast<Eigen::Index>(fine.unknown_count()));
    std::int32_t row = 0;
    for_each_item(homes_of_unknowns(fine), [&](const Home& home) {
        matrix.startVec(row);
        const CoarseFunctions functions = coarse_functions(fine, coarse, home, weights);
        for (int i = 0; i < functions.size; ++i) {
            matrix.insertBack(row, functions.unknowns[i]) =
                1.0F / static_cast<float>(functions.size);
        }
        ++row;
    });
    matrix.finalize();
    return matrix;
}

SparseMatrix transposed(const SparseMatrix& matrix) {
    SparseMatrix result(matrix.cols(), matrix.rows());
    result.resizeNonZeros(matrix.nonZeros());
    std::int32_t* const begin = result.outerIndexPtr();
    std::fill(begin, begin + result.rows() + 1, 0);
    serial_for(matrix.nonZeros(), [&](std::int64_t k) { ++begin[matrix.innerIndexPtr()[k] + 1]; });
    std::partial_sum(begin, begin + result.rows() + 1, begin);
    std::vector<std::int32_t> next(begin, begin + result.rows());
    serial_for(matrix.rows(), [&](std::int64_t row) {
        const std::int32_t end = matrix.outerIndexPtr()[row + 1];
        for (std::int32_t k = matrix.outerIndexPtr()[row]; k < end; ++k) {
            const std::int32_t place = next[matrix.innerIndexPtr()[k]]++;
            result.innerIndexPtr()[place] = static_cast<std::int32_t>(row);
            result.valuePtr()[place] = matrix.valuePtr()[k];
        }
    });
    return result;
}

}  // namespace tracked_mcf
