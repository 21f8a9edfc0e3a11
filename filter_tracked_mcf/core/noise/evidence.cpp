// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/evidence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include "filter_tracked_mcf/core/noise/flatness.h"
#include "filter_tracked_mcf/core/noise/smoothing.h"

namespace tracked_mcf {

namespace {

/// The sizes of the steps, the length of their metric, that of the heights' normals, and the size
/// of the normals' smoothing.
constexpr std::array<double, 3> kSizesOfSteps = {0.15, 0.6, 2.4};
constexpr std::size_t kMiddle = 1;
constexpr double kLengthOfSteps = 1.3, kLengthOfHeights = 2.6, kSizeForNormals = 2;
/// Steps of diffusion that average over about 150 vertices; a window counts if this share of it
/// does, and so many of them are needed.
constexpr int kStepsOfWindow = 40;
constexpr float kLeastOfWindow = 0.25F;
constexpr std::size_t kLeastWindows = 100;
constexpr float kLeastSquare = 1e-18F;

double quantile(std::vector<float> values, double share) {
    const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return double{values[static_cast<std::size_t>(place)]};
}

/// A window has white noise if it is as high as this, in edges, rises and grows by less than this,
/// and hardly an edge there is flat.
constexpr float kLeastWhite = 0.05F, kMostRiseOfWhite = 1.12F, kMostGrowthOfWhite = 1.25F,
                kMostFlatOfWhite = 0.05F;
/// There is white noise in places if so many windows have some, this share of all, and half of them
/// show so many times the median of all, and rise by less than this: at most 1.06 with noise, 1.10
/// on cloth of 4 edges. Patches of cloth that pass have a kurtosis of at most 2.13, noise at least
/// 2.6.
constexpr std::size_t kLeastWhiteWindows = 100;
constexpr double kLeastWhiteShare = 0.02, kOverMedianOfAll = 2.5, kMostMedianRise = 1.07,
                 kLeastWhiteKurtosis = 2.3;

/// A vertex is still if it moves by less than this times the deviation, which is this share of
/// normally distributed heights.
constexpr double kStill = 0.25, kStillOfNoise = 0.1974;

/// What steps show in a window, one after the other, and the heights that they take from the vertex
/// in the middle, relative to the deviation in the window.
struct Window {
    std::int32_t vertex = 0;
    std::array<float, 3> shown{};
    std::array<double, 3> heights{};
};

bool is_white(const std::array<float, 3>& shown) {
    return shown[1] > kLeastWhite && shown[1] < kMostRiseOfWhite * shown[0] &&
           shown[0] < kMostRiseOfWhite * shown[1] && shown[2] < kMostGrowthOfWhite * shown[1];
}

/// Returns the mean of a power of the heights that the second step takes.
double moment(const std::vector<Window>& windows, int power) {
    double sum = 0;
    for (const Window& window : windows) sum += std::pow(window.heights[kMiddle], power);
    return sum / static_cast<double>(windows.size());
}

/// Returns how many vertices the first step leaves still, over how many noise does.
double stillness_of(const std::vector<Window>& windows) {
    const auto count = std::count_if(windows.begin(), windows.end(), [](const Window& window) {
        return std::abs(window.heights[0]) < kStill;
    });
    return static_cast<double>(count) / (kStillOfNoise * static_cast<double>(windows.size()));
}

/// Returns what a step shows in windows.
std::vector<float> shown_by(const std::vector<Window>& windows, std::size_t step) {
    std::vector<float> shown(windows.size());
    std::transform(windows.begin(), windows.end(), shown.begin(),
                   [&](const Window& window) { return window.shown[step]; });
    return shown;
}

/// Returns whether these of all windows have white noise. `median` is of what the second step shows
/// in all.
bool is_white_in_places(const std::vector<Window>& white, std::size_t all, double median) {
    if (white.size() < kLeastWhiteWindows || moment(white, 4) < kLeastWhiteKurtosis) return false;
    std::vector<float> rises(white.size());
    std::transform(white.begin(), white.end(), rises.begin(),
                   [](const Window& window) { return window.shown[kMiddle] / window.shown[0]; });
    return static_cast<double>(white.size()) >= kLeastWhiteShare * static_cast<double>(all) &&
           quantile(rises, 0.5) <= kMostMedianRise &&
           quantile(shown_by(white, kMiddle), 0.5) >= kOverMedianOfAll * median;
}

/// Makes steps of a sample, each from the same positions, and shows them to windows.
class Steps {
public:
    Steps(const Sample& sample, double crease)
        : sample_(sample),
          unit_(crease > 0 ? 1 / crease : 0),
          box_(confinement(sample.surface.positions)),
          smoothing_(sample.surface),
          normals_(smoothing_.smooth_normals(sample.surface.positions,
                                             {kLengthOfHeights * unit_, 0, kSizeForNormals})),
          inside_(sample.counts.begin(), sample.counts.end()) {
        diffuse(sample.surface.stars, kStepsOfWindow, inside_);
    }

    std::vector<Window> windows() const {
        std::vector<Window> windows;
        for (std::int32_t vertex = 0; vertex < sample_.surface.stars.count(); ++vertex) {
            if (sample_.counts[vertex] == 0 || inside_[vertex] <= kLeastOfWindow) continue;
            windows.emplace_back();
            windows.back().vertex = vertex;
        }
        return windows;
    }

    /// A step that would take a vertex away is none, and shows 0.
    void show(std::size_t step, std::vector<Window>& windows) {
        const NoisySurface& surface = sample_.surface;
        Positions moved = surface.positions;
        std::vector<float> kept = sample_.signs;
        smoothing_.step({kLengthOfSteps * unit_, kSizesOfSteps[step], kSizeForNormals}, box_, moved,
                        kept);
        std::vector<float> heights(kept.size(), 0), squares(kept.size(), 0),
            of_signs(kept.size(), 0);
        parallel_for_rows(surface.stars.count(), [&](std::int32_t vertex) {
            if (sample_.counts[vertex] == 0) return;
            heights[vertex] =
                static_cast<float>((moved[vertex] - surface.positions[vertex])
                                       .dot(normals_[vertex].head<3>().cast<double>()));
            const float taken = sample_.signs[vertex] - kept[vertex];
            squares[vertex] = heights[vertex] * heights[vertex];
            of_signs[vertex] = taken * taken;
        });
        diffuse(surface.stars, kStepsOfWindow, squares);
        diffuse(surface.stars, kStepsOfWindow, of_signs);
        for (Window& window : windows) {
            const std::int32_t vertex = window.vertex;
            const float square = squares[vertex];
            window.shown[step] = std::sqrt(square / (of_signs[vertex] + kLeastSquare));
            window.heights[step] =
                double{heights[vertex] / std::sqrt(square / inside_[vertex] + kLeastSquare)};
        }
    }

private:
    const Sample& sample_;
    const double unit_;
    const Eigen::AlignedBox3d box_;
    Smoothing smoothing_;
    const Vectors normals_;
    std::vector<float> inside_;  ///< per vertex: share of its window that counts
};

}  // namespace

Evidence evidence_of(const Sample& sample, double crease, double rounding) {
    Steps steps(sample, crease);
    std::vector<Window> windows = steps.windows();
    if (windows.size() < kLeastWindows) return {};
    std::array<double, kSizesOfSteps.size()> low{};
    for (std::size_t i = 0; i < low.size(); ++i) {
        steps.show(i, windows);
        low[i] = quantile(shown_by(windows, i), 0.25);
    }
    const std::vector<float> shown = shown_by(windows, kMiddle);
    const double median = quantile(shown, 0.5);
    if (!(low[0] > 0 && median > 0)) return {};
    const Stars& stars = sample.surface.stars;
    std::vector<float> flat = flatness_of(stars, sample.surface.positions, rounding).share;
    diffuse(stars, kStepsOfWindow, flat);
    std::vector<Window> white;
    std::copy_if(windows.begin(), windows.end(), std::back_inserter(white),
                 [&](const Window& window) {
                     return is_white(window.shown) && flat[window.vertex] < kMostFlatOfWhite;
                 });
    Evidence evidence;
    evidence.height = low[1];
    evidence.rise = low[1] / low[0];
    evidence.growth = low[2] / low[1];
    evidence.evenness = quantile(shown, 0.1) / median;
    evidence.skewness = moment(windows, 3);
    evidence.kurtosis = moment(windows, 4);
    evidence.stillness = stillness_of(windows);
    evidence.is_white_in_places = is_white_in_places(white, windows.size(), median);
    return evidence;
}

namespace {

/// There is noise that neighbours share if it is as high as this, in edges, rises and grows by so
/// much, and is as even as this, less a share of what it grows beyond noise with the same rise.
constexpr double kLeastShared = 0.05, kLeastRise = 0.15, kMostGrowthOfShared = 2.4,
                 kLeastEvenness = 0.775, kShareOfExcess = 0.15, kGrowthOfRise = 0.9;
/// Noise is as often above the surface as below it, and normally distributed.
constexpr double kMostSkewed = 0.3, kLeastKurtosis = 2.4, kMostKurtosis = 3.5, kMostStill = 1.2;
/// Waves of one length grow by less than this times their rise, noise by 0.7 or more.
constexpr double kLeastGrowthOfRise = 0.6;
/// White noise beside detail rises by less than kClearRise, and grows by more than this times its
/// rise. If so, noise must be so even.
constexpr double kClearRise = 0.4, kClearGrowthOfRise = 1.5, kLeastEvennessIfUnclear = 0.82;
/// Even where single vertices show noise, it is wider if it grows by less than this times its rise.
constexpr double kMostGrowthOfRise = 1.8;
/// Its width follows from the rise, and its height. Where the surface has detail, a little too
/// little is better than too much.
constexpr double kUsualRise = 1.2, kWidthOfUsualRise = 2, kWidthOfRise = 1.4, kLeastWidth = 1.6,
                 kMostWidth = 3.4, kHeightOfRise = 1.6, kShareOfHeight = 0.9;

/// What single vertices show is a pattern if it rises by more than this, and has less kurtosis than
/// noise: cloth of 4 edges rises by at least 1.13, and heights that are rounded, whose kurtosis is
/// as low, by 1.03. It is one, too, if it rises a little more, and leaves so many vertices still,
/// or if its outliers are not farther from normally distributed than this. Pits of 8 and 12 edges
/// rise by at least 1.147; they have at least 1.8 of still vertices, and a kurtosis of at most 3.7.
/// On 18 scans and parts with noise of 0.05 edges or more, white noise has at most 1.22 of still
/// vertices, and outliers a kurtosis of at least 4.0.
constexpr double kMostRiseOfRounding = 1.08, kMostRiseOfNoise = 1.13, kMostStillOfWhite = 1.5,
                 kLeastKurtosisOfOutliers = 3.85;

}  // namespace

bool is_pattern(const Evidence& evidence, NoiseKind kind) {
    if (evidence.rise <= kMostRiseOfRounding) return false;
    if (evidence.kurtosis < kLeastKurtosis) return true;
    if (evidence.rise <= kMostRiseOfNoise) return false;
    return (kind == NoiseKind::White && evidence.stillness > kMostStillOfWhite) ||
           (kind == NoiseKind::Outliers && evidence.kurtosis < kLeastKurtosisOfOutliers);
}

SharedNoise shared_noise_of(const Evidence& evidence, bool beside_white) {
    const double rise = evidence.rise - 1, growth = evidence.growth - 1,
                 excess = std::max(0.0, growth - kGrowthOfRise * rise);
    const bool is_clear = rise >= kClearRise || growth <= kClearGrowthOfRise * rise;
    const bool is_normal = std::abs(evidence.skewness) <= kMostSkewed &&
                           evidence.kurtosis >= kLeastKurtosis &&
                           evidence.kurtosis <= kMostKurtosis && evidence.stillness <= kMostStill;
    const bool is_noise = is_normal && evidence.height >= kLeastShared && rise >= kLeastRise &&
                          evidence.growth <= kMostGrowthOfShared &&
                          growth >= kLeastGrowthOfRise * rise &&
                          evidence.evenness - kShareOfExcess * excess >=
                              (is_clear ? kLeastEvenness : kLeastEvennessIfUnclear);
    if (!is_noise || (beside_white && growth > kMostGrowthOfRise * rise)) return {};
    return lumps_of(evidence);
}

SharedNoise lumps_of(const Evidence& evidence) {
    if (!(evidence.height > 0)) return {};
    const double width = kWidthOfUsualRise + kWidthOfRise * (evidence.rise - kUsualRise);
    return {std::clamp(width, kLeastWidth, kMostWidth),
            kShareOfHeight * evidence.height * (1 + kHeightOfRise * (evidence.rise - 1))};
}

}  // namespace tracked_mcf
