// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/system/element_matrices.h"

#include <algorithm>
#include <numeric>

#include "filter_tracked_mcf/core/flow/kernels/integrate_elements.h"
#include "filter_tracked_mcf/core/parallel/parallel.h"

namespace tracked_mcf {

namespace {

IntegrationInput integration_input(const TrackedElements& elements,
                                   const Coefficients& displacement, double step_size) {
    IntegrationInput input = {};
    input.unknowns = elements.finest().unknowns.data()->data();
    input.displacement = displacement.data();
    input.samples.packed_local[0] = elements.samples.packed_local(0);
    input.samples.packed_local[1] = elements.samples.packed_local(1);
    input.samples.weight = elements.samples.weights();
    input.samples.fragments = elements.fragments.data();
    input.samples.sample_begin = elements.sample_begin.data();
    input.samples.fragment_begin = elements.fragment_begin.data();
    input.step_size_in_squared_cells = static_cast<float>(step_size);
    return input;
}

/// Calls body(input) for batches of elements that cover [begin, end).
template <class Body>
void for_each_batch(const TrackedElements& elements, const IntegrationInput& all,
                    std::int64_t begin, std::int64_t end, const Body& body) {
    Pacer pacer;
    IntegrationInput batch = all;
    for (batch.begin = begin; batch.begin < end; batch.begin = batch.end) {
        batch.end = std::min(end, batch.begin + kElementBatch);
        body(batch);
        pacer.did(elements.sample_begin[batch.end] - elements.sample_begin[batch.begin]);
    }
}

/// Returns the product of an element's matrix and a vector, one row for each corner of its cell.
using CornerRows = Eigen::Matrix<double, 8, 3>;
CornerRows product(const TrackedElements& elements, const MatrixBlocks& matrices,
                   const Coefficients& vector, std::int32_t element) {
    const auto& unknowns = elements.finest().unknowns[element];
    const ElementMatrix matrix = matrices.of(element);
    CornerRows rows;
    for (int row = 0; row < 8; ++row) {
        Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
        for (int corner = 0; corner < 8; ++corner) {
            sum += matrix.entry[row][corner] * vector.row(unknowns[corner]);
        }
        rows.row(row) = sum;
    }
    return rows;
}

}  // namespace

void assemble_elements(const TrackedElements& elements, const Coefficients& displacement,
                       double step_size, bool keep_stiffness, ElementSystems& systems) {
    const std::int64_t count = elements.finest().element_count();
    systems.matrices.resize(count);
    systems.right_sides.resize(static_cast<std::size_t>(count));
    systems.areas.resize(static_cast<std::size_t>(count));
    if (keep_stiffness) systems.stiffnesses.resize(count);
    const IntegrationInput all = integration_input(elements, displacement, step_size);
    const IntegrationOutput output = {systems.matrices.blocks(),
                                      keep_stiffness ? systems.stiffnesses.blocks() : nullptr,
                                      systems.right_sides.data(), systems.areas.data()};
    systems.collapsed_samples =
        parallel_sum(count, std::int64_t{0}, [&](std::int64_t begin, std::int64_t end) {
            std::int64_t collapsed = 0;
            for_each_batch(elements, all, begin, end, [&](const IntegrationInput& batch) {
                collapsed += integrate_elements(batch, output);
            });
            return collapsed;
        });
    systems.area = std::accumulate(systems.areas.begin(), systems.areas.end(), 0.0);
}

void multiply(const TrackedElements& elements, const MatrixBlocks& matrices,
              const Coefficients& vector, std::vector<ElementVector>& products) {
    products.resize(static_cast<std::size_t>(elements.finest().element_count()));
    parallel_for_rows(elements.finest().element_count(), [&](std::int32_t element) {
        const CornerRows rows = product(elements, matrices, vector, element);
        for (int row = 0; row < 8; ++row) {
            for (int axis = 0; axis < 3; ++axis) {
                products[element].entry[axis][row] = static_cast<float>(rows(row, axis));
            }
        }
    });
}

}  // namespace tracked_mcf
