#include "filter_tracked_mcf/core/element_matrices.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "filter_tracked_mcf/core/interruptible.h"
#include "filter_tracked_mcf/core/kernels/kernels.h"
#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

namespace {

IntegrationInput integration_input(const TrackedElements& elements,
                                   const Coefficients& displacement, const SystemWeights& weights) {
    IntegrationInput input = {};
    input.unknowns = elements.finest().unknowns.data()->data();
    input.displacement = displacement.data();
    input.samples.places[0] = elements.samples.places(0);
    input.samples.places[1] = elements.samples.places(1);
    input.samples.weight = elements.samples.weights();
    input.samples.fragments = elements.fragments.data();
    input.samples.sample_begin = elements.sample_begin.data();
    input.samples.fragment_begin = elements.fragment_begin.data();
    input.mass = weights.mass;
    input.stiffness = weights.stiffness;
    input.initial_metric = weights.flow == FlowKind::Conformalized;
    return input;
}

}  // namespace

void assemble_elements(const TrackedElements& elements, const Coefficients& displacement,
                       const SystemWeights& weights, ElementSystems& systems) {
    IntegrateElements& integrate_elements = *kernels().integrate_elements;
    const std::int64_t count = elements.finest().element_count();
    systems.matrices.resize(count);
    resize(systems.right_sides, count);
    resize(systems.areas, count);
    const IntegrationInput all = integration_input(elements, displacement, weights);
    const IntegrationOutput output = {systems.matrices.blocks(), systems.right_sides.data(),
                                      systems.areas.data()};
    systems.collapses = parallel_collect<Collapse>(
        count, [&](std::int64_t begin, std::int64_t end, std::vector<Collapse>& collapses) {
            Pacer pacer;
            IntegrationInput batch = all;
            for (batch.begin = begin; batch.begin < end; batch.begin = batch.end) {
                batch.end = std::min(end, batch.begin + kElementBatch);
                std::array<Collapse, kElementBatch> collapsed;
                const int collapsed_count = integrate_elements(batch, output, collapsed.data());
                collapses.insert(collapses.end(), collapsed.begin(),
                                 collapsed.begin() + collapsed_count);
                pacer.did(elements.sample_begin[batch.end] - elements.sample_begin[batch.begin]);
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
        const ElementMatrix matrix = systems.matrices.of(element);
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
