// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>

#include "filter_tracked_mcf/core/flow/kernels/integrate_elements.h"
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
        const std::uint32_t x = rounded(kSampleSteps * local[0]);
        const std::uint32_t y = rounded(kSampleSteps * local[1]);
        const std::uint32_t z = rounded(kSampleSteps * local[2]);
        packed_local_[0][sample] = x << kPackedShift | z >> kPackedShift;
        packed_local_[1][sample] = y << kPackedShift | (z & kPackedMask);
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
    /// Returns w_p, the area of the initial surface that a sample stands for, in grid units².
    float weight(std::int64_t sample) const { return weight_[sample]; }

    const std::uint32_t* packed_local(int word) const { return packed_local_[word].data(); }
    const float* weights() const { return weight_.data(); }

private:
    /// Returns what std::lround would, which is a slow call. The number is negative by rounding
    /// errors at most.
    static std::uint32_t rounded(double number) {
        const auto below = static_cast<std::int32_t>(number);
        return static_cast<std::uint32_t>(below + (number - below >= 0.5 ? 1 : 0));
    }
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
