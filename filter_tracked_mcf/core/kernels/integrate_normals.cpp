// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/kernels/integrate_normals.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "filter_tracked_mcf/core/kernels/integrate_normals.cpp"
#include "filter_tracked_mcf/core/kernels/targets.h"

#include "filter_tracked_mcf/core/kernels/element_batch.h"
#include "filter_tracked_mcf/core/kernels/sample_chunk.h"

HWY_BEFORE_NAMESPACE();
namespace tracked_mcf::HWY_NAMESPACE {

namespace {

/// Adds the integrals over a chunk's samples to the element's, with one lane for each sample.
void add_normals(const Embedding& embedding, const SampleChunk& chunk, Lanes (&sums)[3][8]) {
    for (int i = 0; i < chunk.count; i += kLanes) {
        const Lanes weight = weights(chunk, i);
        const Differential d = differentials(embedding, chunk, i);
        const Lanes force = hn::Neg(weight);
        const Lanes forces[3] = {force * d.normal.x, force * d.normal.y, force * d.normal.z};
        for (int corner = 0; corner < 8; ++corner) {
            const Lanes value = load(chunk.linear[bit(corner, 0)] + i) *
                                load(chunk.linear[2 + bit(corner, 1)] + i) *
                                load(chunk.linear[4 + bit(corner, 2)] + i);
            for (int axis = 0; axis < 3; ++axis) {
                sums[axis][corner] = hn::MulAdd(value, forces[axis], sums[axis][corner]);
            }
        }
    }
}

void integrate(const SampleArrays& samples, const Embedding& embedding, std::int64_t element,
               ElementVector& normals) {
    SampleReader reader = read_element(samples, element);
    SampleChunk chunk;
    Lanes sums[3][8];
    for (auto& of_axis : sums) set_zero(of_axis);
    while (reader.left > 0) {
        read_samples(reader, chunk);
        evaluate_functions(chunk);
        add_normals(embedding, chunk, sums);
    }
    for (int axis = 0; axis < 3; ++axis) {
        for (int corner = 0; corner < 8; ++corner) {
            alignas(64) float lanes[kLanes];
            store(sums[axis][corner], lanes);
            float sum = 0;
            for (const float of_lane : lanes) sum += of_lane;
            normals.entry[axis][corner] = sum;
        }
    }
}

}  // namespace

void integrate_normals(const IntegrationInput& input, ElementVector* normals) {
    for (std::int64_t begin = input.begin; begin < input.end; begin += kLanes) {
        const std::int64_t left = input.end - begin;
        const int count = left < kLanes ? static_cast<int>(left) : kLanes;
        ElementBatch batch = {};
        read_embedding(input, begin, count, batch);
        for (int lane = 0; lane < count; ++lane) {
            integrate(input.samples, embedding_of(batch, lane), begin + lane,
                      normals[begin + lane]);
        }
    }
}

}  // namespace tracked_mcf::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
