// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "filter_tracked_mcf/core/kernels/integrate_elements.h"
#include "filter_tracked_mcf/core/parallel/raw_vector.h"

namespace tracked_mcf {

/// The samples of a surface, as one array per number, so that kernels can read several samples at a
/// time.
class Samples {
public:
    static constexpr std::int64_t kBytesPerSample = 2 * sizeof(std::uint32_t) + sizeof(float);

    /// Every sample must be set before it is read.
    void resize(std::int64_t count) {
        count_ = count;
        for (auto& words : packed_local_) resize(words);
        resize(weight_);
    }
    void set(std::int64_t sample, const Eigen::Vector3d& local, double weight) {
        std::uint32_t steps[3];
        for (int axis = 0; axis < 3; ++axis) {
            steps[axis] = static_cast<std::uint32_t>(std::lround(kSampleSteps * local[axis]));
        }
        packed_local_[0][sample] = steps[0] << kPackedShift | steps[2] >> kPackedShift;
        packed_local_[1][sample] = steps[1] << kPackedShift | (steps[2] & kPackedMask);
        weight_[sample] = static_cast<float>(weight);
    }

    std::int64_t size() const { return count_; }
    /// Returns the local coordinates of a sample in its cell, 0 to 1.
    Eigen::Vector3d local(std::int64_t sample) const {
        const std::uint32_t a = packed_local_[0][sample];
        const std::uint32_t b = packed_local_[1][sample];
        const Eigen::Vector3d steps(a >> kPackedShift, b >> kPackedShift,
                                    (a & kPackedMask) << kPackedShift | (b & kPackedMask));
        return steps / kSampleSteps;
    }
    /// Returns w_p, the area of the initial surface that a sample stands for, in grid units.
    float weight(std::int64_t sample) const { return weight_[sample]; }

    const std::uint32_t* packed_local(int word) const { return packed_local_[word].data(); }
    const float* weights() const { return weight_.data(); }

private:
    template <class Number>
    void resize(RawVector<Number>& numbers) const {
        numbers.resize(static_cast<std::size_t>(count_ + kSamplePadding));
        std::fill(numbers.begin() + count_, numbers.end(), Number{0});
    }

    std::int64_t count_ = 0;
    RawVector<std::uint32_t> packed_local_[2];
    RawVector<float> weight_;
};

}  // namespace tracked_mcf
