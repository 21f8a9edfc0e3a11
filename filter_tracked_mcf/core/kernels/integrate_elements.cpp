// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/kernels/integrate_elements.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter_tracked_mcf/core/kernels/integrate_elements.cpp"
#include "filter_tracked_mcf/core/kernels/targets.h"

#include "filter_tracked_mcf/core/kernels/element_batch.h"
#include "filter_tracked_mcf/core/kernels/moments.h"
#include "filter_tracked_mcf/core/kernels/sample_chunk.h"

HWY_BEFORE_NAMESPACE();
namespace tracked_mcf::HWY_NAMESPACE {

namespace {

bool any_collapsed(const SampleChunk& chunk) {
    int collapsed = 0;
    for (int i = 0; i < chunk.count; ++i) collapsed |= chunk.area[i] > 0 ? 0 : 1;
    return collapsed != 0;
}

/// Adds the collapsed samples of a chunk. Few chunks have any.
void count_collapsed(const SampleChunk& chunk, Collapse& collapse) {
    for (int i = 0; i < chunk.count; ++i) {
        const float weight = chunk.samples.weight[i];
        if (chunk.area[i] > 0 || weight <= 0) continue;
        ++collapse.samples;
        for (int corner = 0; corner < 8; ++corner) {
            collapse.mass[corner] += weight * chunk.bernstein[2 * bit(corner, 0)][i] *
                                     chunk.bernstein[3 + 2 * bit(corner, 1)][i] *
                                     chunk.bernstein[6 + 2 * bit(corner, 2)][i];
        }
    }
}

/// Sums an element's moments and its collapsed samples.
void integrate(const IntegrationInput& input, const Embedding& embedding, std::int64_t element,
               float (&moments)[kMomentRows], Collapse& collapse) {
    SampleReader reader = read_element(input.samples, element);
    SampleChunk chunk;
    while (reader.left > 0) {
        read_samples(reader, chunk);
        if (input.initial_metric) {
            evaluate_samples(embedding, Metric::Initial, chunk);
        } else {
            evaluate_samples(embedding, Metric::Present, chunk);
        }
        if (!input.initial_metric && any_collapsed(chunk)) count_collapsed(chunk, collapse);
        add_moments(chunk, moments);
    }
}

}  // namespace

int integrate_elements(const IntegrationInput& input, const IntegrationOutput& output,
                       Collapse* collapses) {
    int collapse_count = 0;
    for (std::int64_t begin = input.begin; begin < input.end; begin += kLanes) {
        const std::int64_t left = input.end - begin;
        const int count = left < kLanes ? static_cast<int>(left) : kLanes;
        ElementBatch batch = {};
        read_embedding(input, begin, count, batch);
        for (int lane = 0; lane < count; ++lane) {
            Collapse collapse = {static_cast<std::int32_t>(begin + lane), 0, {}};
            integrate(input, embedding_of(batch, lane), begin + lane, batch.moments[lane],
                      collapse);
            if (collapse.samples > 0) collapses[collapse_count++] = collapse;
        }
        write_systems(input, begin, count, batch, output);
    }
    return collapse_count;
}

}  // namespace tracked_mcf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
