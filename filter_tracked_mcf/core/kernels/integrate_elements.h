#pragma once

#include <cstdint>

#include "filter_tracked_mcf/core/element_matrix.h"
#include "filter_tracked_mcf/core/surface_samples.h"

namespace tracked_mcf {

/// As many elements as are integrated together at most.
inline constexpr int kElementBatch = kBlockElements;

/// What the integrals over consecutive elements need.
struct IntegrationInput {
    std::int64_t begin;            ///< the first element, a multiple of kElementBatch
    std::int64_t end;              ///< behind the last: at most kElementBatch more
    const std::int32_t* unknowns;  ///< of every element's eight corners
    const double* displacement;    ///< of the embedding X_t, three for every unknown, grid units
    SampleArrays samples;
    float mass;           ///< weight of ∫ B_I B_J
    float stiffness;      ///< weight of ∫ ∇B_I · ∇B_J
    bool initial_metric;  ///< the stiffness is that of the initial surface; then nothing collapses
};

/// Where the results go: arrays of all elements, of which those from begin to end are set; of
/// matrices beyond the end, some are set to zero.
struct IntegrationOutput {
    MatrixBlock* matrices;  ///< blocks of them
    ElementVector* right_sides;
    float* areas;  ///< of the embedded surface in each element, grid units²
};

/// Integrates elements by their samples; see assemble_elements. Writes about those in which samples
/// have collapsed to `collapses`, which has room for one for each element; returns how many.
using IntegrateElements = int(const IntegrationInput& input, const IntegrationOutput& output,
                              Collapse* collapses);

}  // namespace tracked_mcf
