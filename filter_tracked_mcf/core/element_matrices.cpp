#include "filter_tracked_mcf/core/element_matrices.h"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/kernels/kernels.h"
#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

namespace {

ElementInput gather(const TrackedElements& elements, const Coefficients& displacement,
                    const SystemWeights& weights, std::int64_t element) {
    ElementInput input;
    const auto& unknowns = elements.finest().unknowns[element];
    for (int axis = 0; axis < 3; ++axis) {
        const double base = displacement(unknowns[0], axis);
        for (int corner = 0; corner < 8; ++corner) {
            input.displacement[axis][corner] =
                static_cast<float>(displacement(unknowns[corner], axis) - base);
        }
    }
    const Fragment* fragments = elements.fragments.data();
    input.fragments = fragments + elements.fragment_begin[element];
    input.fragments_end = fragments + elements.fragment_begin[element + 1];
    input.samples = elements.samples.data() + elements.sample_begin[element];
    input.mass = weights.mass;
    input.stiffness = weights.stiffness;
    input.initial_metric = weights.flow == FlowKind::Conformalized;
    return input;
}

Collapse collapse_of(std::int64_t element, const ElementTotals& totals) {
    Collapse collapse;
    collapse.element = static_cast<std::int32_t>(element);
    collapse.samples = totals.collapsed_samples;
    std::copy(std::begin(totals.collapsed_mass), std::end(totals.collapsed_mass), collapse.mass);
    return collapse;
}

}  // namespace

void assemble_elements(const TrackedElements& elements, const Coefficients& displacement,
                       const SystemWeights& weights, ElementSystems& systems) {
    IntegrateElement& integrate_element = *kernels().integrate_element;
    const std::int64_t count = elements.finest().element_count();
    resize(systems.matrices, count);
    resize(systems.right_sides, count);
    resize(systems.areas, count);
    systems.collapses = parallel_collect<Collapse>(
        count, [&](std::int64_t begin, std::int64_t end, std::vector<Collapse>& collapses) {
            Pacer pacer;
            for (std::int64_t element = begin; element < end; ++element) {
                const ElementTotals totals =
                    integrate_element(gather(elements, displacement, weights, element),
                                      systems.matrices[element], systems.right_sides[element]);
                systems.areas[element] = totals.area;
                if (totals.collapsed_samples > 0) collapses.push_back(collapse_of(element, totals));
                pacer.did(elements.sample_begin[element + 1] - elements.sample_begin[element]);
            }
        });
    systems.area = std::accumulate(systems.areas.begin(), systems.areas.end(), 0.0);
    systems.collapsed_samples = 0;
    for (const Collapse& collapse : systems.collapses) {
        systems.collapsed_samples += collapse.samples;
    }
}

void subtract_guess(const TrackedElements& elements, const Coefficients& guess,
                    ElementSystems& systems) {
    parallel_for_rows(elements.finest().element_count(), [&](std::int32_t element) {
        const auto& unknowns = elements.finest().unknowns[element];
        const ElementMatrix& matrix = systems.matrices[element];
        for (int row = 0; row < 8; ++row) {
            Eigen::RowVector3d product = Eigen::RowVector3d::Zero();
            for (int corner = 0; corner < 8; ++corner) {
                product += matrix.entry[row][corner] * guess.row(unknowns[corner]);
            }
            for (int axis = 0; axis < 3; ++axis) {
                systems.right_sides[element].entry[axis][row] -= static_cast<float>(product[axis]);
            }
        }
    });
}

}  // namespace tracked_mcf
