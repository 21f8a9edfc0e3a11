// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/solver/element_smoother.h"

#include <algorithm>

#include "filter_tracked_mcf/core/flow/system/constrained_cells.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// Returns 1 / m_e for each element.
std::vector<float> damping_of(const Level& level) {
    std::vector<std::int32_t> sharing(level.unknown_count(), 0);
    for (const auto& unknowns : level.unknowns) {
        for (const std::int32_t unknown : unknowns) ++sharing[unknown];
    }
    std::vector<float> damping(level.unknowns.size());
    parallel_for_rows(level.element_count(), [&](std::int32_t element) {
        std::int32_t most = 1;
        for (const std::int32_t unknown : level.unknowns[element]) {
            most = std::max(most, sharing[unknown]);
        }
        damping[element] = 1.0F / static_cast<float>(most);
    });
    return damping;
}

/// A pivot below this fraction of its diagonal entry is a rounding error: its function depends on
/// the functions before it, and its row is left out.
constexpr float kDependent = 1e-5F;

/// Four floats, one for each of four elements.
using Lanes = Eigen::Array4f;
constexpr int kLanes = 4;

/// Reads the lower triangle of the assembled matrix, restricted to the unknowns of one element.
void restrict(const Level& level, const MatrixBlocks& matrices, std::int32_t element,
              Lanes (&m)[8][8], int lane) {
    const auto& unknowns = level.unknowns[element];
    for (int i = 0; i < 8; ++i) {
        for (int j = i; j < 8; ++j) m[j][i][lane] = 0;
        for (const std::int32_t index : level.corners.members(unknowns[i])) {
            // The other cell has corner j, too, unless it is on the far side along an axis in which
            // the cells differ. Close sheets have other unknowns there.
            const std::int32_t other = index / 8;
            const int moved = i ^ (index % 8);
            for (int j = i; j < 8; ++j) {
                if (((i ^ j) & moved) != 0 || level.unknowns[other][j ^ moved] != unknowns[j])
                    continue;
                m[j][i][lane] += matrices[other](i ^ moved, j ^ moved);
            }
        }
    }
}

/// Inverts kLanes symmetric positive semi-definite matrices in place, as L⁻ᵀ D⁻¹ L⁻¹. This is a sum
/// of squares, so it is positive despite rounding errors; an inverse by elimination need not be.
/// Rows that are left out become zero.
void invert(Lanes (&m)[8][8]) {
    Lanes least[8];
    Lanes inverse_pivot[8];
    for (int k = 0; k < 8; ++k) least[k] = kDependent * m[k][k];
    // Factorise into L, below the diagonal, and D.
    for (int k = 0; k < 8; ++k) {
        const Lanes pivot = m[k][k];
        // Written so that a NaN propagates.
        for (int lane = 0; lane < kLanes; ++lane) {
            inverse_pivot[k][lane] = pivot[lane] <= least[k][lane] ? 0 : 1 / pivot[lane];
        }
        Lanes column[8];
        for (int i = k + 1; i < 8; ++i) column[i] = m[i][k];
        for (int i = k + 1; i < 8; ++i) {
            const Lanes factor = column[i] * inverse_pivot[k];
            for (int j = k + 1; j <= i; ++j) m[i][j] -= factor * column[j];
            m[i][k] = factor;
        }
    }
    // Replace L by L⁻¹ below the diagonal.
    for (int i = 0; i < 8; ++i) {
        for (int j = 0; j < i; ++j) {
            Lanes sum = m[i][j];
            for (int k = j + 1; k < i; ++k) sum = m[i][k] * m[k][j] + sum;
            m[i][j] = -sum;
        }
    }
    for (int i = 0; i < 8; ++i) {
        for (int j = 0; j <= i; ++j) {
            Lanes sum = j < i ? inverse_pivot[i] * m[i][j] : inverse_pivot[i];
            for (int k = i + 1; k < 8; ++k) {
                sum = inverse_pivot[k] * m[k][i] * m[k][j] + sum;
            }
            m[i][j] = sum;
        }
    }
}

}  // namespace

ElementSmoother::ElementSmoother(const Level& level, const ElementPartition& partition)
    : level_(level),
      partition_(partition),
      damping_(damping_of(level)),
      inverses_(level.unknowns.size()),
      free_unknowns_(level.unknown_count()) {}

void ElementSmoother::refresh(const MatrixBlocks& matrices) {
    parallel_for_rows(level_.unknown_count(), [&](std::int32_t unknown) {
        float diagonal = 0;
        for (const std::int32_t index : level_.corners.members(unknown))
            diagonal += matrices[index / 8](index % 8, index % 8);
        free_unknowns_[unknown] = is_free(diagonal) ? 1 : 0;
    });
    parallel_for_chunks(level_.element_count(), [&](std::int64_t begin, std::int64_t end) {
        Lanes m[8][8] = {};
        for (auto first = static_cast<std::int32_t>(begin); first < end; first += kLanes) {
            const int count = std::min(kLanes, static_cast<std::int32_t>(end) - first);
            for (int lane = 0; lane < count; ++lane)
                restrict(level_, matrices, first + lane, m, lane);
            invert(m);
            for (int lane = 0; lane < count; ++lane) {
                for (int i = 0; i < 8; ++i) {
                    for (int j = i; j < 8; ++j)
                        inverses_[first + lane](i, j) = damping_[first + lane] * m[j][i][lane];
                }
            }
        }
    });
}

void ElementSmoother::correct(const Field* base, float factor, const Field& residual,
                              Field& x) const {
    partition_.add_products(inverses_, factor, residual, base, x);
}

}  // namespace tracked_mcf
