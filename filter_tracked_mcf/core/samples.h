#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>

#include "filter_tracked_mcf/core/raw_vector.h"
#include "filter_tracked_mcf/core/surface_samples.h"

namespace tracked_mcf {

/// The samples of a surface, number by number, so that kernels can read several of them at a time.
class Samples {
public:
    static constexpr std::int64_t kBytesPerSample = 4 * sizeof(float);

    /// Each sample must then be set.
    void resize(std::int64_t count) {
        count_ = count;
        for (auto& numbers : local_) resize(numbers);
        resize(weight_);
    }
    void set(std::int64_t sample, const Eigen::Vector3d& local, double weight) {
        for (int axis = 0; axis < 3; ++axis) {
            local_[axis][sample] = static_cast<float>(local[axis]);
        }
        weight_[sample] = static_cast<float>(weight);
    }

    std::int64_t size() const { return count_; }
    /// Local coordinates in its cell, 0 to 1.
    Eigen::Vector3d local(std::int64_t sample) const {
        return {local_[0][sample], local_[1][sample], local_[2][sample]};
    }
    /// w_p: area that it stands for on the initial surface, grid units².
    float weight(std::int64_t sample) const { return weight_[sample]; }

    const float* local_array(int axis) const { return local_[axis].data(); }
    const float* weight_array() const { return weight_.data(); }

private:
    void resize(RawVector<float>& numbers) const {
        numbers.resize(static_cast<std::size_t>(count_ + kSamplePadding));
        std::fill(numbers.begin() + count_, numbers.end(), 0.0F);
    }

    std::int64_t count_ = 0;
    RawVector<float> local_[3];
    RawVector<float> weight_;
};

}  // namespace tracked_mcf
