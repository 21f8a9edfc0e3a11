// SPDX-License-Identifier: GPL-3.0-or-later
#include "filter_tracked_mcf/core/noise/label_smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "filter_tracked_mcf/core/mesh/measures.h"
#include "filter_tracked_mcf/core/noise/candidate.h"
#include "filter_tracked_mcf/core/noise/smoothing.h"
#include "filter_tracked_mcf/core/pi.h"

namespace tracked_mcf {

namespace {

/// How far the shape may be from the border, in cells.
constexpr double kHalfACell = 0.5;

/// The steps of the smoothing, and of a random walk of about five cells. Lengths are in cells; that
/// of normals is relative to the least crease. Terraces of thick slices are wide, so the walk and
/// the step size grow with the proportions of a cell.
constexpr double kLabelNormalLength = 2.6, kLabelNormalStep = 4, kLabelStep = 2.4, kWalk = 50;

/// The volume is restored in so many rounds, since bounds stop some of it.
constexpr int kRoundsOfVolume = 3;

/// Stars are judged on a sample. A star is calm if its triangles are within this angle, RMS.
constexpr std::size_t kJudgedStars = 1000;
constexpr double kCalm = 12 * kPi / 180;

/// Labels are certain from so many kinds of stars on, times the square of the share of calm ones.
/// Gears have 45 to 140, most labels more than 100, models of steps at most 45.
constexpr double kLeastKinds = 45;
/// Small labels have few stars. But nearly each is of its own kind, as otherwise in random patterns
/// alone, of which fewer stars become calm.
constexpr double kAllKinds = 0.9, kSomeCalm = 0.1;
/// Marching cubes of a smooth field may be at few fractions, too, if it repeats itself. But
/// smoothing leaves its stars at least 0.78 times as uneven, and those of averaged labels mostly
/// 0.07 to 0.6 times.
constexpr double kMostUnevenness = 0.65;
/// Fewer stars than the first number tell nothing, and fewer than the second not everything.
constexpr std::size_t kLeastStars = 50, kFewStars = 250;

/// A label that was resampled to a grid turned against its own has larger cells. It leaves 0.13 to
/// 0.3 of its uneven vertices at their bounds, and others at most 0.11 if cells are no thicker than
/// the third number. At least the fourth number of its stars are of different kinds, and as many
/// calm; models of steps have fewer. The least cells are taken that leave the second share there.
constexpr double kMostAtBounds = 0.125, kFewAtBounds = 0.02, kThick = 3, kLeastOfLabel = 0.5;
constexpr std::array<double, 5> kLargerCells = {1.5, 2, 2.5, 3, 4};

std::uint64_t mixed(std::uint64_t bits) {
    bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9U;
    bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebU;
    return bits ^ (bits >> 31U);
}

/// Returns the kind of a star with two rings: the same if a shift moves one onto the other. The sum
/// does not depend on the order of the neighbours.
std::uint64_t kind_of(const Labels& labels, std::int32_t vertex) {
    const Stars& stars = labels.surface.stars;
    const Positions& positions = labels.surface.positions;
    const auto number_of = [&](std::int32_t other) {
        constexpr std::int64_t most = 32;  // halves of cells that an offset has
        std::uint64_t number = 1;
        for (const double offset : positions[other] - positions[vertex]) {
            number = 2 * most * number + static_cast<std::uint64_t>(
                                             std::lround(2 * labels.subdivision * offset) + most);
        }
        return mixed(number);
    };
    std::uint64_t kind = 0;
    for_each_neighbour(stars, vertex, [&](std::int32_t neighbour) {
        kind += 3 * number_of(neighbour);
        for_each_neighbour(stars, neighbour, [&](std::int32_t other) { kind += number_of(other); });
    });
    return kind;
}

/// Returns the mean squared distance of a star's unit normals from the direction of their mean: the
/// squared angle, if it is small.
double unevenness(const Stars& stars, const Positions& positions, std::int32_t vertex) {
    // It is 2 - 2 |m|, where m is the mean.
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double area = 0;
    for_each_corner(stars, vertex, [&](std::uint32_t triangle, std::uint32_t /*corner*/) {
        const auto [a, b, c] = corners_of(positions, stars.triangles[triangle]);
        const Eigen::Vector3d normal = twice_vector_area(a, b, c);
        sum += normal;
        area += normal.norm();
    });
    return area > 0 ? 2 * (1 - sum.norm() / area) : 2;
}

/// What smoothing shows of some stars.
struct Judgement {
    double count = 0;              ///< of stars
    double kinds = 0;              ///< effective number of different ones
    double calm = 0;               ///< share of calm ones
    double before = 0, after = 0;  ///< sums of their unevenness
};

/// Judges some stars, given the positions after smoothing, in cells.
Judgement judged(const Labels& labels, const Positions& positions,
                 const std::vector<std::int32_t>& stars) {
    const std::size_t count = std::min(stars.size(), kJudgedStars);
    Judgement result;
    result.count = static_cast<double>(count);
    std::map<std::uint64_t, double> kinds;
    for (std::size_t i = 0; i < count; ++i) {
        const std::int32_t vertex = stars[i * stars.size() / count];
        ++kinds[kind_of(labels, vertex)];
        const double smoothed = unevenness(labels.surface.stars, positions, vertex);
        if (smoothed < kCalm * kCalm) result.calm += 1 / result.count;
        result.before += unevenness(labels.surface.stars, labels.surface.positions, vertex);
        result.after += smoothed;
    }
    double entropy = 0;
    for (const auto& [kind, times] : kinds)
        entropy -= times / result.count * std::log(times / result.count);
    result.kinds = std::exp(entropy);
    return result;
}

/// Returns whether stars are certain to be those of a label.
bool are_of_label(const Judgement& stars, bool is_soft) {
    if (stars.count < kLeastStars) return false;
    if (is_soft && stars.after > kMostUnevenness * stars.before) return false;
    return stars.kinds * stars.calm * stars.calm >= kLeastKinds ||
           (stars.kinds >= kAllKinds * stars.count && stars.calm >= kSomeCalm);
}

/// Judges each part.
std::vector<Judgement> judged_parts(const Labels& labels, const Positions& positions) {
    std::vector<std::size_t> part_of(positions.size());
    for (std::size_t part = 0; part < labels.ranges.size(); ++part) {
        const PartRange& range = labels.ranges[part];
        std::fill(part_of.begin() + range.first_vertex, part_of.begin() + range.end_vertex, part);
    }
    std::vector<std::vector<std::int32_t>> stars(labels.ranges.size());
    for (const std::int32_t vertex : in_rank(labels.surface.positions)) {
        if (labels.uneven[vertex] != 0) stars[part_of[vertex]].push_back(vertex);
    }
    std::vector<Judgement> judgements(stars.size());
    std::transform(stars.begin(), stars.end(), judgements.begin(),
                   [&](const auto& of_part) { return judged(labels, positions, of_part); });
    return judgements;
}

std::size_t largest_part(const Labels& labels) {
    const auto largest = std::max_element(
        labels.ranges.begin(), labels.ranges.end(),
        [](const PartRange& a, const PartRange& b) { return a.vertex_count() < b.vertex_count(); });
    return static_cast<std::size_t>(largest - labels.ranges.begin());
}

/// Returns per part whether it is certain to be a label.
std::vector<std::uint8_t> certain_parts(const Labels& labels, const std::vector<Judgement>& parts) {
    const bool is_soft = labels.lattice.is_soft;
    const bool is_largest = are_of_label(parts[largest_part(labels)], is_soft);
    std::vector<std::uint8_t> certain(parts.size());
    std::transform(parts.begin(), parts.end(), certain.begin(), [&](const Judgement& part) {
        return are_of_label(part, is_soft) || (part.count < kFewStars && is_largest) ? 1 : 0;
    });
    return certain;
}

/// Smooths labels in cells.
class LabelSmoothing {
public:
    /// `walk` are the steps of a random walk over what counts as shape.
    LabelSmoothing(const Labels& labels, int walk)
        : labels_(labels),
          walk_(walk),
          start_(labels.surface.positions),
          smoothing_(labels.surface) {}

    Positions result(StepSettings settings) {
        Positions positions = start_;
        const Eigen::AlignedBox3d box = confinement(start_);
        for (int step = 0; step < kStepsOfLabels; ++step) {
            make_step(settings, [&] { return smoothing_.step(settings, box, positions); });
            give_shape_back(positions);
            keep_in_cells(positions);
        }
        for (int round = 0; round < kRoundsOfVolume; ++round) {
            for (const PartRange& part : labels_.ranges) give_volume_back(part, positions);
            keep_in_cells(positions);
        }
        return positions;
    }

    int iterations() const { return smoothing_.iterations(); }

private:
    Eigen::Vector3d normal(std::int32_t vertex) const {
        return smoothing_.normals()[vertex].head<3>().cast<double>();
    }

    void give_shape_back(Positions& positions) const {
        std::vector<float> moved(positions.size());
        parallel_for_rows(labels_.surface.stars.count(), [&](std::int32_t i) {
            moved[i] = static_cast<float>((positions[i] - start_[i]).dot(normal(i)));
        });
        diffuse(labels_.surface.stars, walk_, moved);
        parallel_for_rows(labels_.surface.stars.count(),
                          [&](std::int32_t i) { positions[i] -= moved[i] * normal(i); });
    }

    void give_volume_back(const PartRange& part, Positions& positions) const {
        const RawVector<Triangle>& triangles = labels_.surface.stars.triangles;
        double swept = 0, area = 0;
        for (std::int64_t i = part.first_triangle; i < part.end_triangle; ++i) {
            const auto corners = corners_of(positions, triangles[i]);
            swept += swept_volume(corners_of(start_, triangles[i]), corners);
            area += twice_vector_area(corners[0], corners[1], corners[2]).norm() / 2;
        }
        if (!(area > 0)) return;
        const double height = std::clamp(-swept / area, -kHalfACell / 2, kHalfACell / 2);
        for (std::int32_t i = part.first_vertex; i < part.end_vertex; ++i)
            positions[i] += height * normal(i);
    }

    void keep_in_cells(Positions& positions) const {
        parallel_for_rows(labels_.surface.stars.count(), [&](std::int32_t i) {
            for (Eigen::Index side = 0; side < 3; ++side) {
                const bool stays =
                    labels_.surface.is_held(i) || (labels_.flat_sides[i] >> side & 1) != 0;
                const double bound = stays ? 0 : kHalfACell;
                double& coordinate = positions[i][side];
                coordinate =
                    std::clamp(coordinate, start_[i][side] - bound, start_[i][side] + bound);
            }
        });
    }

    const Labels& labels_;
    const int walk_;
    const Positions& start_;
    Smoothing smoothing_;
};

double thickness_of(const Labels& labels) {
    const Eigen::Vector3d lengths = labels.lattice.cell.colwise().norm();
    return lengths.maxCoeff() / lengths.minCoeff();
}

/// Returns the same labels as if their cells were so many times as wide.
Labels in_larger_cells(Labels labels, double cells) {
    labels.lattice.cell *= cells;
    labels.subdivision *= cells;
    for (Eigen::Vector3d& position : labels.surface.positions) position /= cells;
    return labels;
}

/// Returns the share of uneven vertices that are as far from their start as they may be.
double share_at_bounds(const Labels& labels, const Positions& positions) {
    constexpr double nearly = 0.999 * kHalfACell;
    double all = 0, at_bounds = 0;
    for (std::size_t i = 0; i < positions.size(); ++i) {
        if (labels.uneven[i] == 0) continue;
        ++all;
        const Eigen::Vector3d moved = positions[i] - labels.surface.positions[i];
        if (moved.lpNorm<Eigen::Infinity>() > nearly) ++at_bounds;
    }
    return all > 0 ? at_bounds / all : 0;
}

Positions smoothed(const Labels& labels, double crease, bool along_normals, int& iterations) {
    // The metric counts in sides of the grid.
    const double width = labels.subdivision, area = width * width;
    const double thickness = thickness_of(labels);
    StepSettings settings;
    settings.normal_length = crease > 0 ? width * kLabelNormalLength / crease : 0;
    settings.normal_step_size = area * kLabelNormalStep;
    settings.step_size = area * kLabelStep * std::sqrt(thickness);
    settings.sideways = along_normals ? 0 : kHalfACell;
    LabelSmoothing smoothing(labels, static_cast<int>(kWalk * area * thickness));
    Positions positions = smoothing.result(settings);
    iterations += smoothing.iterations();
    return positions;
}

/// Returns whether the cells may be larger than those of the grid: they leave vertices at their
/// bounds, and stars are those of a label rather than of a model of steps.
bool may_be_larger(const Labels& labels, const Positions& positions, const Judgement& stars) {
    return labels.lattice.is_marching && labels.subdivision == 1 &&
           thickness_of(labels) <= kThick && stars.kinds >= kLeastOfLabel * stars.count &&
           stars.calm >= kLeastOfLabel && share_at_bounds(labels, positions) > kMostAtBounds;
}

}  // namespace

SmoothLabels without_stairs(const Labels& labels, double crease, bool along_normals) {
    SmoothLabels result;
    result.positions = smoothed(labels, crease, along_normals, result.iterations);
    const std::vector<Judgement> parts = judged_parts(labels, result.positions);
    result.are_certain = certain_parts(labels, parts);
    if (may_be_larger(labels, result.positions, parts[largest_part(labels)])) {
        for (const double cells : kLargerCells) {
            const Labels larger = in_larger_cells(labels, cells);
            Positions positions = smoothed(larger, crease, along_normals, result.iterations);
            if (share_at_bounds(larger, positions) > kFewAtBounds) continue;
            result.are_certain = certain_parts(larger, judged_parts(larger, positions));
            result.cells = cells;
            for (Eigen::Vector3d& position : positions) position *= cells;
            result.positions = std::move(positions);
            break;
        }
    }
    for (Eigen::Vector3d& position : result.positions)
        position = labels.lattice.cell * position + labels.lattice.origin;
    return result;
}

}  // namespace tracked_mcf
