// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/comb.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace tracked_mcf {

namespace {

/// So many values are on a comb. A common one is there three times.
constexpr double kOnComb = 0.95;
constexpr std::size_t kTimes = 3;

/// Values differ if they are farther apart than this, in edges; common ones among others if they
/// are farther apart than the second number, as these may be close by.
constexpr double kSame = 0.02, kSameAmongOthers = 5e-4;

/// So many of the commonest values are tried as a comb.
constexpr std::array<std::size_t, 5> kCommonest = {3, 5, 8, 12, 20};

/// Equal values.
struct Tooth {
    double value, count;
};

std::vector<Tooth> teeth_of(std::vector<double> values, double same) {
    std::sort(values.begin(), values.end());
    std::vector<Tooth> teeth;
    for (std::size_t begin = 0, end = 0; begin < values.size(); begin = end) {
        double sum = 0;
        do {
            sum += values[end++];
        } while (end < values.size() && values[end] - values[end - 1] <= same);
        const auto count = static_cast<double>(end - begin);
        teeth.push_back({sum / count, count});
    }
    return teeth;
}

/// Fits a comb by least squares. Indices are counted from tooth to tooth, so that an error of the
/// distance does not add up.
Comb fitted(const std::vector<Tooth>& teeth, double distance) {
    double index = 0, last = teeth[0].value;
    double count = 0, i1 = 0, i2 = 0, v1 = 0, iv = 0;
    for (const Tooth& tooth : teeth) {
        const double steps = (tooth.value - last) / distance;
        if (from_whole(steps) > 0.2) continue;
        index += std::round(steps);
        last = tooth.value;
        count += tooth.count;
        i1 += tooth.count * index;
        i2 += tooth.count * index * index;
        v1 += tooth.count * tooth.value;
        iv += tooth.count * index * tooth.value;
    }
    const double determinant = count * i2 - i1 * i1;
    if (!(determinant > 0)) return {};
    return {(count * iv - i1 * v1) / determinant, (i2 * v1 - i1 * iv) / determinant};
}

}  // namespace

Comb comb_of(const std::vector<double>& values) {
    const std::vector<Tooth> teeth = teeth_of(values, kSame);
    if (teeth.size() < 2) return {};
    std::vector<double> gaps(teeth.size() - 1);
    for (std::size_t i = 0; i < gaps.size(); ++i) gaps[i] = teeth[i + 1].value - teeth[i].value;
    std::sort(gaps.begin(), gaps.end());
    Comb widest;
    // Vertices off the lattice make small gaps.
    for (const std::size_t place : {std::size_t{0}, gaps.size() / 4, gaps.size() / 2}) {
        Comb comb = fitted(teeth, gaps[place]);
        if (comb.distance > kSame) comb = fitted(teeth, comb.distance);
        if (!(comb.distance > std::max(widest.distance, kSame))) continue;
        double on = 0;
        for (const Tooth& tooth : teeth) {
            if (from_whole(comb.index_of(tooth.value)) < kWhole) on += tooth.count;
        }
        if (on >= kOnComb * static_cast<double>(values.size())) widest = comb;
    }
    return widest;
}

bool has_equal_values(const std::vector<double>& values) {
    constexpr double others = 0.9;
    return static_cast<double>(teeth_of(values, kSameAmongOthers).size()) <=
           others * static_cast<double>(values.size());
}

std::vector<Comb> combs_of_commonest(const std::vector<double>& values) {
    std::vector<Tooth> commonest = teeth_of(values, kSameAmongOthers);
    std::stable_sort(commonest.begin(), commonest.end(),
                     [](const Tooth& a, const Tooth& b) { return a.count > b.count; });
    std::vector<Comb> combs;
    for (const std::size_t count : kCommonest) {
        if (count > commonest.size() || commonest[count - 1].count < kTimes) break;
        std::vector<Tooth> teeth(commonest.begin(),
                                 commonest.begin() + static_cast<std::ptrdiff_t>(count));
        std::sort(teeth.begin(), teeth.end(),
                  [](const Tooth& a, const Tooth& b) { return a.value < b.value; });
        double gap = teeth[1].value - teeth[0].value;
        for (std::size_t i = 2; i < count; ++i)
            gap = std::min(gap, teeth[i].value - teeth[i - 1].value);
        const Comb comb = fitted(teeth, gap);
        if (comb.distance > kSame) combs.push_back(comb);
    }
    return combs;
}

}  // namespace tracked_mcf
