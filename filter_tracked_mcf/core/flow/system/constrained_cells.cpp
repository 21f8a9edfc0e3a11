// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/system/constrained_cells.h"

#include "filter_tracked_mcf/core/flow/cells/bspline.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

/// Marks the elements of the next coarser level that contain a marked element.
std::vector<std::uint8_t> mark_parents(const Level& fine, const Level& coarse,
                                       const std::vector<std::uint8_t>& marked) {
    std::vector<std::uint8_t> parents(static_cast<std::size_t>(coarse.element_count()), 0);
    for (std::int32_t element = 0; element < fine.element_count(); ++element) {
        if (marked[element] != 0) parents[fine.parents[element]] = 1;
    }
    return parents;
}

/// Marks the unknowns whose function's support contains a marked element.
std::vector<std::uint8_t> mark_unknowns(const Level& level,
                                        const std::vector<std::uint8_t>& marked) {
    std::vector<std::uint8_t> unknowns(static_cast<std::size_t>(level.unknown_count()), 0);
    for (std::int32_t element = 0; element < level.element_count(); ++element) {
        if (marked[element] == 0) continue;
        for (const std::int32_t unknown : level.unknowns[element]) unknowns[unknown] = 1;
    }
    return unknowns;
}

/// The mean square of a negligible function.
constexpr double kNegligible = 1e-8;

}  // namespace

std::vector<std::vector<std::uint8_t>> constrained_unknowns(const TrackedElements& elements) {
    std::vector<std::vector<std::uint8_t>> constrained(elements.levels.size());
    std::vector<std::uint8_t> marked = elements.meets_held_side;
    for (std::size_t l = elements.levels.size(); l-- > 0;) {
        constrained[l] = mark_unknowns(elements.levels[l], marked);
        if (l > 0) marked = mark_parents(elements.levels[l], elements.levels[l - 1], marked);
    }
    return constrained;
}

void constrain_negligible(const TrackedElements& elements, std::vector<std::uint8_t>& constrained) {
    const Level& finest = elements.finest();
    struct Integrals {
        CornerValues squares = CornerValues::Zero();
        double area = 0;
    };
    std::vector<Integrals> of_elements(finest.cells.size());
    parallel_for_rows(finest.element_count(), [&](std::int32_t element) {
        Integrals& sum = of_elements[element];
        for (auto i = elements.sample_begin[element]; i < elements.sample_begin[element + 1]; ++i) {
            const double weight = elements.samples.weight(i);
            sum.squares += weight * bspline_values(elements.samples.local(i)).cwiseAbs2();
            sum.area += weight;
        }
    });
    std::vector<double> squares(constrained.size()), areas(constrained.size());
    for (std::int32_t element = 0; element < finest.element_count(); ++element) {
        for (int corner = 0; corner < 8; ++corner) {
            const std::int32_t unknown = finest.unknowns[element][corner];
            squares[unknown] += of_elements[element].squares[corner];
            areas[unknown] += of_elements[element].area;
        }
    }
    for (std::size_t i = 0; i < constrained.size(); ++i) {
        if (squares[i] <= kNegligible * areas[i]) constrained[i] = 1;
    }
}

void eliminate_constrained(const Level& level, const std::vector<std::uint8_t>& constrained,
                           MatrixBlocks& matrices) {
    parallel_for_rows(level.element_count(), [&](std::int32_t element) {
        for (int corner = 0; corner < 8; ++corner) {
            if (constrained[level.unknowns[element][corner]] == 0) continue;
            for (int i = 0; i < 8; ++i) matrices[element](corner, i) = 0;
        }
    });
}

}  // namespace tracked_mcf
