#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "filter_tracked_mcf/core/raw_vector.h"
#include "filter_tracked_mcf/core/surface_samples.h"

namespace tracked_mcf {

/// The samples of a surface, number by number, so that kernels can read several of them at a time.
class Samples {
public:
    static constexpr std::int64_t kBytesPerSample = 2 * sizeof(std::uint32_t) + sizeof(float);

    /// Each sample must then be set.
    void resize(std::int64_t count) {
        count_ = count;
        for (auto& words : places_) resize(words);
        resize(weight_);
    }
    void set(std::int64_t sample, const Eigen::Vector3d& local, double weight) {
        std::uint32_t steps[3];
        for (int axis = 0; axis < 3; ++axis) {
            steps[axis] = static_cast<std::uint32_t>(std::lround(kSampleSteps * local[axis]));
        }
        places_[0][sample] = steps[0] << kPlaceShift | steps[2] >> kPlaceShift;
        places_[1][sample] = steps[1] << kPlaceShift | (steps[2] & kPlaceMask);
        weight_[sample] = static_cast<float>(weight);
    }

    std::int64_t size() const { return count_; }
    /// Local coordinates in its cell, 0 to 1.
    Eigen::Vector3d local(std::int64_t sample) const {
        const std::uint32_t a = places_[0][sample];
        const std::uint32_t b = places_[1][sample];
        const Eigen::Vector3d steps(a >> kPlaceShift, b >> kPlaceShift,
                                    (a & kPlaceMask) << kPlaceShift | (b & kPlaceMask));
        return steps / kSampleSteps;
    }
    /// w_p: area that it stands for on the initial surface, grid units².
    float weight(std::int64_t sample) const { return weight_[sample]; }

    const std::uint32_t* places(int word) const { return places_[word].data(); }
    const float* weights() const { return weight_.data(); }

private:
    template <class Number>
    void resize(RawVector<Number>& numbers) const {
        numbers.resize(static_cast<std::size_t>(count_ + kSamplePadding));
        std::fill(numbers.begin() + count_, numbers.end(), Number{0});
    }

    std::int64_t count_ = 0;
    RawVector<std::uint32_t> places_[2];
    RawVector<float> weight_;
};

}  // namespace tracked_mcf
