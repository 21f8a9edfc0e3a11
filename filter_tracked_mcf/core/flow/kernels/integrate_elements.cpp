// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/flow/kernels/integrate_elements.h"

#include "filter_tracked_mcf/core/flow/kernels/element_batch.h"
#include "filter_tracked_mcf/core/flow/kernels/moments.h"
#include "filter_tracked_mcf/core/flow/kernels/sample_chunk.h"

namespace tracked_mcf::kernels {

namespace {

/// Returns the number of collapsed samples of a chunk.
std::int64_t count_collapsed(const SampleChunk& chunk) {
    std::int64_t count = 0;
    for (int i = 0; i < chunk.count; ++i) {
        count += chunk.area[i] <= 0 && chunk.samples.weight[i] > 0 ? 1 : 0;
    }
    return count;
}

/// Sums an element's moments, and returns the number of its collapsed samples.
std::int64_t integrate(const SampleArrays& samples, const Embedding& embedding,
                       std::int64_t element, float (&moments)[kMomentRows]) {
    SampleReader reader = read_element(samples, element);
    SampleChunk chunk;
    std::int64_t collapsed = 0;
    while (reader.left > 0) {
        read_samples(reader, chunk);
        evaluate_samples(embedding, chunk);
        collapsed += count_collapsed(chunk);
        add_moments(chunk, moments);
    }
    return collapsed;
}

}  // namespace

}  // namespace tracked_mcf::kernels

namespace tracked_mcf {

std::int64_t integrate_elements(const IntegrationInput& input, const IntegrationOutput& output) {
    using namespace kernels;
    std::int64_t collapsed = 0;
    for (std::int64_t begin = input.begin; begin < input.end; begin += kLanes) {
        const std::int64_t left = input.end - begin;
        const int count = left < kLanes ? static_cast<int>(left) : kLanes;
        ElementBatch batch = {};
        read_embedding(input, begin, count, batch);
        for (int lane = 0; lane < count; ++lane) {
            collapsed += integrate(input.samples, embedding_of(batch, lane), begin + lane,
                                   batch.moments[lane]);
        }
        write_systems(input, begin, count, batch, output);
    }
    return collapsed;
}

}  // namespace tracked_mcf
