// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "filter_tracked_mcf/core/flow/cells/bspline.h"
#include "filter_tracked_mcf/core/flow/elements/samples.h"
#include "filter_tracked_mcf/core/flow/kernels/integrate_elements.h"

namespace tracked_mcf {

/// Elements with samples anywhere. No two elements share unknowns.
struct Surface {
    std::vector<Fragment> fragments;
    Samples samples;
    std::vector<std::int64_t> sample_begin;
    std::vector<std::int64_t> fragment_begin;
    std::vector<std::int32_t> unknowns;
    std::vector<Matrix83> displacement;  ///< of each element, one row for each corner

    std::int64_t element_count() const { return static_cast<std::int64_t>(displacement.size()); }

    SampleArrays arrays() const {
        return {{samples.packed_local(0), samples.packed_local(1)},
                samples.weights(),
                fragments.data(),
                sample_begin.data(),
                fragment_begin.data()};
    }
};

/// Numbers of samples around the widths of vectors and of a chunk, and zero.
inline constexpr std::array<int, 20> kSampleCounts = {
    59, 0, 1, 3, 4, 7, 8, 9, 15, 16, 17, 33, 127, 128, 129, 300, 512, 900, 2500, 6};

/// Makes a surface with random samples, normals and displacements.
class SurfaceMaker {
public:
    Surface make() {
        Surface surface;
        std::int64_t samples = 0;
        for (const int count : kSampleCounts) {
            surface.sample_begin.push_back(samples);
            surface.fragment_begin.push_back(static_cast<std::int64_t>(surface.fragments.size()));
            add_fragments(count, surface);
            add_corners(surface);
            samples += count;
        }
        surface.sample_begin.push_back(samples);
        surface.fragment_begin.push_back(static_cast<std::int64_t>(surface.fragments.size()));
        surface.samples.resize(samples);
        for (std::int64_t sample = 0; sample < samples; ++sample) {
            surface.samples.set(sample, vector(0, 1), uniform(0.001, 1));
        }
        return surface;
    }

private:
    double uniform(double from, double to) {
        return std::uniform_real_distribution<double>(from, to)(random_);
    }
    Eigen::Vector3d vector(double from, double to) {
        return {uniform(from, to), uniform(from, to), uniform(from, to)};
    }

    void add_fragments(int samples, Surface& surface) {
        while (samples > 0) {
            const int count = std::min(samples, static_cast<int>(uniform(0, 40)));
            const Eigen::Vector3f normal = vector(-1, 1).normalized().cast<float>();
            surface.fragments.push_back({{normal[0], normal[1], normal[2]}, count});
            samples -= count;
        }
    }

    void add_corners(Surface& surface) {
        const auto first = static_cast<std::int32_t>(surface.unknowns.size());
        Matrix83 displacement;
        for (int corner = 0; corner < 8; ++corner) {
            // Out of order, so that nothing can rely on an order.
            surface.unknowns.push_back(first + (3 * corner + 5) % 8);
            displacement.row(corner) =
                100 * Eigen::RowVector3d::Ones() + vector(-0.2, 0.2).transpose();
        }
        surface.displacement.push_back(displacement);
    }

    std::mt19937 random_{6};
};

inline std::vector<double> displacement_array(const Surface& surface) {
    std::vector<double> array(3 * surface.unknowns.size());
    for (std::size_t i = 0; i < surface.unknowns.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            array[3 * static_cast<std::size_t>(surface.unknowns[i]) +
                  static_cast<std::size_t>(axis)] =
                surface.displacement[i / 8](static_cast<int>(i % 8), axis);
        }
    }
    return array;
}

/// Returns the embedding of an element in its cell: the corners' displacements and places.
inline Matrix83 embedding_of(const Surface& surface, std::size_t element) {
    Matrix83 x = surface.displacement[element];
    for (int corner = 0; corner < 8; ++corner) {
        for (int axis = 0; axis < 3; ++axis) x(corner, axis) += corner_bit(corner, axis);
    }
    return x;
}

/// Calls visit(normal, local, weight) for each sample of an element.
template <class Visit>
void for_each_sample(const Surface& surface, std::size_t element, const Visit& visit) {
    std::int64_t sample = surface.sample_begin[element];
    for (std::int64_t f = surface.fragment_begin[element]; f < surface.fragment_begin[element + 1];
         ++f) {
        const Fragment& fragment = surface.fragments[static_cast<std::size_t>(f)];
        const Eigen::Vector3d normal =
            Eigen::Map<const Eigen::Vector3f>(fragment.normal).cast<double>();
        for (int i = 0; i < fragment.sample_count; ++i, ++sample) {
            visit(normal, surface.samples.local(sample), surface.samples.weight(sample));
        }
    }
    EXPECT_EQ(sample, surface.sample_begin[element + 1]);
}

}  // namespace tracked_mcf
