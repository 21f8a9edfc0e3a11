// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/fidelities.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tracked_mcf {

namespace {

// Constants were chosen on fandisk, cube, hand_8k, nefertiti_50k and armadillo_50k.

/// Steps of diffusion that average over about 100 and 300 vertices.
constexpr int kSmallWindow = 28, kWindow = 83;

/// A normally distributed height has this standard deviation relative to its median magnitude, and
/// relative to the exponential of the mean logarithm of its magnitude.
constexpr double kOverMedian = 1.4826, kOverLogarithm = 1.887;
/// Logarithms are those of heights plus this share of their deviation.
constexpr double kShareOfDeviation = 0.01;

/// There are outliers where robust deviations within windows are less than this share of the root
/// mean squares: 0.98 to 1.08 with normally distributed noise, 0.33 to 0.76 with impulses. With
/// less noise than this, in edges, what stands out is detail.
constexpr double kMostRobust = 0.8, kLeastNoise = 0.02;
/// Detail stands out along lines: beside vertices with less fidelity than this, others like them
/// are more frequent than elsewhere, by this factor at least. It is 0.8 to 1.9 with impulses, and
/// 11 along the thin edges of a clean blade.
constexpr float kStandsOut = 0.3F;
constexpr double kMostCrowded = 4;
/// Noise varies where the logarithm of its deviation within windows varies by more than this: at
/// most 0.12 where it is the same everywhere, at least 0.34 where it varies threefold.
constexpr double kMostSpread = 0.18;

/// A fidelity is this power of the inverse of the noise. It is less than 2 because surfaces have
/// less and less of shorter waves, so that the square itself would smooth too much where noise is
/// large.
constexpr float kPower = 1.5F;

/// Heights of so many deviations have a quarter of the weight.
constexpr float kOutlier = 3;
constexpr float kLeastFidelity = 0.003F, kMostFidelity = 1000;

constexpr float kTiny = 1e-18F;

double median_of(std::vector<float> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return double{*middle};
}

/// Returns function(value) of each value.
template <class Function>
std::vector<float> map(const std::vector<float>& values, const Function& function) {
    std::vector<float> results(values.size());
    parallel_for_rows(static_cast<std::int64_t>(values.size()),
                      [&](std::int32_t i) { results[i] = function(values[i]); });
    return results;
}

/// Returns the deviation of most heights.
double robust_deviation(const std::vector<float>& heights) {
    return kOverMedian * median_of(map(heights, [](float height) { return std::abs(height); }));
}

/// Returns the mean logarithm of heights in windows around the vertices.
std::vector<float> mean_logarithms(const Stars& stars, const std::vector<float>& heights,
                                   double deviation, int steps) {
    const float least = static_cast<float>(kShareOfDeviation * deviation) + kTiny;
    std::vector<float> logarithms =
        map(heights, [&](float height) { return std::log(std::abs(height) + least); });
    diffuse(stars, steps, logarithms);
    return logarithms;
}

/// Returns the deviation of most heights within a window around each vertex.
std::vector<float> robust_deviations(const Stars& stars, const std::vector<float>& heights,
                                     double deviation) {
    return map(mean_logarithms(stars, heights, deviation, kSmallWindow), [](float logarithm) {
        return static_cast<float>(kOverLogarithm) * std::exp(logarithm);
    });
}

std::vector<float> mean_squares(const Stars& stars, const std::vector<float>& heights, int steps) {
    std::vector<float> squares = map(heights, [](float height) { return height * height; });
    diffuse(stars, steps, squares);
    return squares;
}

/// Returns the values of vertices that count.
std::vector<float> counted(const std::vector<float>& values,
                           const std::vector<std::uint8_t>& counts) {
    std::vector<float> result;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (counts[i] != 0) result.push_back(values[i]);
    }
    return result;
}

/// Returns whether the vertices that stand out do so alone, not along lines.
bool are_scattered(const Stars& stars, const std::vector<float>& heights,
                   const std::vector<std::uint8_t>& counts) {
    const std::vector<float> fidelities = fidelities_to_outliers(stars, heights);
    double all = 0, some = 0, neighbours = 0, crowded = 0;
    for (std::int32_t vertex = 0; vertex < stars.count(); ++vertex) {
        if (counts[vertex] == 0) continue;
        ++all;
        if (fidelities[vertex] >= kStandsOut) continue;
        ++some;
        for (auto i = stars.neighbour_begin[vertex]; i < stars.neighbour_begin[vertex + 1]; ++i) {
            ++neighbours;
            if (fidelities[stars.neighbours[i]] < kStandsOut) ++crowded;
        }
    }
    return crowded * all <= kMostCrowded * some * neighbours;
}

bool has_outliers(const Stars& stars, const std::vector<float>& heights,
                  const std::vector<std::uint8_t>& counts) {
    std::vector<float> ratios =
        robust_deviations(stars, heights, robust_deviation(counted(heights, counts)));
    const std::vector<float> squares = mean_squares(stars, heights, kSmallWindow);
    for (std::size_t i = 0; i < ratios.size(); ++i) ratios[i] /= std::sqrt(squares[i] + kTiny);
    double sum = 0, count = 0;
    for (const float height : counted(heights, counts)) {
        sum += double{height * height};
        ++count;
    }
    return sum > kLeastNoise * kLeastNoise * count &&
           median_of(counted(ratios, counts)) < kMostRobust &&
           are_scattered(stars, heights, counts);
}

double spread_of(const std::vector<float>& values) {
    double sum = 0, squares = 0;
    for (const float value : values) sum += double{value};
    const auto count = static_cast<double>(values.size());
    for (const float value : values) {
        const double difference = double{value} - sum / count;
        squares += difference * difference;
    }
    return count > 0 ? std::sqrt(squares / count) : 0;
}

bool varies(const Stars& stars, const std::vector<float>& heights,
            const std::vector<std::uint8_t>& counts) {
    const std::vector<float> logarithms =
        map(mean_squares(stars, heights, kWindow),
            [](float square) { return std::log(square + kTiny) / 2; });
    return spread_of(counted(logarithms, counts)) > kMostSpread;
}

}  // namespace

NoiseKind kind_of_noise(const Stars& stars, const std::vector<float>& heights,
                        const std::vector<std::uint8_t>& counts) {
    if (has_outliers(stars, heights, counts)) return NoiseKind::Outliers;
    return varies(stars, heights, counts) ? NoiseKind::Varying : NoiseKind::White;
}

std::vector<float> fidelities_to_noise(const Stars& stars, const std::vector<float>& heights) {
    const std::vector<float> logarithms =
        mean_logarithms(stars, heights, robust_deviation(heights), kWindow);
    const double sum = sum_over_rows(
        stars.count(), [&](std::int32_t vertex) { return double{logarithms[vertex]}; });
    const auto mean = static_cast<float>(sum / stars.count());
    return map(logarithms, [&](float logarithm) {
        return std::clamp(std::exp(kPower * (mean - logarithm)), kLeastFidelity, kMostFidelity);
    });
}

std::vector<float> fidelities_to_outliers(const Stars& stars, const std::vector<float>& heights) {
    const double deviation = robust_deviation(heights);
    std::vector<float> fidelities = robust_deviations(stars, heights, deviation);
    parallel_for_rows(stars.count(), [&](std::int32_t vertex) {
        const float usual = std::max(static_cast<float>(deviation), fidelities[vertex]);
        const float ratio = heights[vertex] / (kOutlier * usual + kTiny);
        const float weight = 1 / (1 + ratio * ratio);
        fidelities[vertex] = std::max(kLeastFidelity, weight * weight);
    });
    return fidelities;
}

}  // namespace tracked_mcf
