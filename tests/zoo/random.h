// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <random>

namespace tracked_mcf::zoo {

/// Random numbers that are the same with every standard library: unlike the engines, its
/// distributions are not specified.
class Random {
public:
    Random(std::uint64_t seed, std::uint64_t number) {
        std::seed_seq sequence{seed & 0xffffffffU, seed >> 32U, number & 0xffffffffU,
                               number >> 32U};
        engine_.seed(sequence);
    }

    /// Returns a number in [0, 1).
    double unit() { return std::ldexp(static_cast<double>(engine_() >> 11U), -53); }
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// Returns a number whose logarithm is uniform.
    double log_between(double low, double high) {
        return std::exp(between(std::log(low), std::log(high)));
    }
    /// Returns an integer in [0, count).
    int below(int count) { return static_cast<int>(unit() * count); }
    /// Returns an integer in [low, high].
    int integer(int low, int high) { return low + below(high - low + 1); }
    bool chance(double probability) { return unit() < probability; }
    template <class Value>
    Value pick(std::initializer_list<Value> values) {
        return values.begin()[below(static_cast<int>(values.size()))];
    }
    /// Returns a point in [-1, 1]³.
    Eigen::Vector3d point() {
        const double x = between(-1, 1), y = between(-1, 1), z = between(-1, 1);
        return {x, y, z};
    }
    /// Returns a point of a cube around 0 whose size is log_between() these.
    Eigen::Vector3d offset(double low, double high) {
        const double size = log_between(low, high);
        return size * point();
    }
    /// Returns a vector of length 1.
    Eigen::Vector3d direction() {
        Eigen::Vector3d vector = point();
        while (!(vector.norm() > 0.1)) vector = point();
        return vector.normalized();
    }

private:
    std::mt19937_64 engine_;
};

}  // namespace tracked_mcf::zoo
